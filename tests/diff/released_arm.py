"""A package with two releases that differ in every kind of name, and a package that uses them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release

from ecm_extract.cli.run import run

HEADER = """#pragma once
namespace arm {
class Driver {
public:
  virtual ~Driver() = default;
  virtual bool start(const Info & info) = 0;
  void stop();
private:
  int state_;
};
namespace detail { void hidden(); }
}
"""
NEW_HEADER = HEADER.replace("start(const Info & info)", "start(const Params & params)").replace(
    "  void stop();\n", "  void stop(bool hard = false);\n"
)


def released(folder: Path) -> Path:
    """A repository with both releases."""
    release(
        folder,
        {
            "arm/package.xml": package("arm"),
            "arm/CMakeLists.txt": (
                "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION x)\n"
                "install(DIRECTORY include/ DESTINATION include)\n"
            ),
            "arm/src/arm.cpp": node(
                'declare_parameter("checker_plugin", "simple");',
                'declare_parameter("rate", 10.0);',
                'pub_ = create_publisher<sensor_msgs::msg::JointState>("~/state/joints", 10);',
                'srv_ = create_service<std_srvs::srv::Trigger>("~/home", cb);',
            ),
            "arm/include/arm/driver.hpp": HEADER,
            "arm_msgs/package.xml": package("arm_msgs"),
            "arm_msgs/msg/Grip.msg": "float64 force\nbool open\n",
            "arm_msgs/msg/Plan.msg": "Grip[] grips\n",
            "arm_msgs/srv/Go.srv": "---\nbool ok\n",
        },
        "1.0.0",
    )
    release(
        folder,
        {
            "arm/package.xml": package("arm", "1.1.0"),
            "arm_msgs/package.xml": package("arm_msgs", "1.1.0"),
            "arm/src/arm.cpp": node(
                'declare_parameter("checker_plugins", std::vector<std::string>{"simple"});',
                'declare_parameter("rate", 20.0);',
                'pub_ = create_publisher<sensor_msgs::msg::JointState>("~/joint_state/raw/joints", 10);',
            ),
            "arm/include/arm/driver.hpp": NEW_HEADER,
            "arm_msgs/msg/Grip.msg": "float64 max_force\nbool open\n",
            "arm_msgs/srv/Go.srv": None,
        },
        "1.1.0",
    )
    return folder


CONSUMER = {
    "user/package.xml": package("user"),
    "user/config/arm.yaml": "arm:\n  ros__parameters:\n    checker_plugin: fine\n    rate: 5.0\n",
    "user/user/watch.py": (
        "import rclpy\nfrom rclpy.node import Node\nfrom sensor_msgs.msg import JointState\n"
        "from arm_msgs.msg import Grip\nfrom arm_msgs.srv import Go\n\n"
        "class Watch(Node):\n    def __init__(self):\n        super().__init__('watch')\n"
        "        self.create_subscription(JointState, '/arm/state/joints', self.on_joints, 10)\n\n"
        "    def grip(self):\n        grip = Grip()\n        grip.force = 3.0\n        return Grip(force=1.0)\n"
    ),
    "user/src/my_driver.cpp": (
        "#include <arm/driver.hpp>\nclass Mine : public arm::Driver {\npublic:\n"
        "  bool start(const arm::Info & info) override { return true; }\n};\n"
    ),
}
FIXED = {
    "user/package.xml": package("user"),
    "user/config/arm.yaml": "arm:\n  ros__parameters:\n    checker_plugins: [fine]\n    rate: 5.0\n",
    "user/user/watch.py": CONSUMER["user/user/watch.py"]
    .replace("/arm/state/joints", "/arm/joint_state/raw/joints")
    .replace("force", "max_force")
    .replace("from arm_msgs.srv import Go\n", ""),
    "user/src/my_driver.cpp": CONSUMER["user/src/my_driver.cpp"].replace("arm::Info & info", "arm::Params & params"),
}


def ran(capsys: pytest.CaptureFixture[str], *args: object) -> tuple[int, str, str]:
    status = run(["diff", *map(str, args)])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def document(capsys: pytest.CaptureFixture[str], *args: object) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(ran(capsys, *args, "--format", "json")[1])
    return found
