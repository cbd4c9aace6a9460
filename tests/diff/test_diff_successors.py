"""Which new name is what became of an old one, and which is not."""

from __future__ import annotations

import pytest
from diff_repos import node, package

CMAKE = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION lib/arm)\n"
Told = set[tuple[str, str, str | None, str | None]]


@pytest.mark.parametrize(
    ("before", "after", "is_renamed"),
    [
        ('p_ = create_publisher<std_msgs::msg::Bool>("%s", 1);', "contact", True),
        ('s_ = create_subscription<std_msgs::msg::Bool>(\n  "%s", 1, std::bind(&Arm::hit, this, _1));', "bump", True),
        ('name_ = declare_parameter("%s", "x");', "namespace", True),
        ('declare_parameter("%s", 1);', "depth", False),
    ],
)
def test_a_line_that_is_the_same_but_for_the_name(told, before: str, after: str, is_renamed: bool) -> None:  # type: ignore[no-untyped-def]
    """A rename, however unlike the names are; a call that tells nothing else says nothing."""
    text = node(before)
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": text.replace("%s", "bumper")}
    found = told(old, {"arm/src/arm.cpp": text.replace("%s", after)})
    assert any(entry[1] == "renamed" for entry in found) is is_renamed


def test_two_names_that_change_places_on_one_kind_of_line(told) -> None:  # type: ignore[no-untyped-def]
    """Where several lines could be the one, none is."""
    text = node(
        'p_[0] = create_publisher<std_msgs::msg::Bool>("%s", 1);',
        'p_[0] = create_publisher<std_msgs::msg::Bool>("%t", 1);',
    )
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": text.replace("%s", "bumper").replace("%t", "cliff")}
    found = told(old, {"arm/src/arm.cpp": text.replace("%s", "left").replace("%t", "right")})
    assert not any(entry[1] == "renamed" for entry in found)


PYTHON = "from setuptools import setup\nsetup(name='arm', packages=['arm'])\n"


def test_no_successor_in_another_language(told) -> None:  # type: ignore[no-untyped-def]
    """Nobody imports a class of C++."""
    old = {"arm/setup.py": PYTHON, "arm/arm/__init__.py": "", "arm/arm/driver.py": "class ArmDriver:\n    pass\n"}
    new = {
        "arm/include/arm/driver.hpp": "#pragma once\nnamespace arm {\nclass ArmDriver {};\n}\n",
        "arm/arm/driver.py": None,
    }
    found = told(old, new)
    assert not [entry for entry in found if entry[1] in {"renamed", "moved"}]


def test_no_successor_that_stood_there_before(told) -> None:  # type: ignore[no-untyped-def]
    """The launch file of another robot has its own history, though it is installed only now."""
    launch = '<launch><node pkg="arm" exec="{}"/></launch>\n'
    old = {"arm/launch/left/start.launch.xml": launch.format("a"), "hand/launch/start.launch.xml": launch.format("b")}
    new = {"arm/launch/left/start.launch.xml": None, "hand/package.xml": package("hand")}
    found = told(old, new)
    assert ("launch_file", "removed", "start.launch.xml", None) in found


def test_symbols_go_with_their_package(changes) -> None:  # type: ignore[no-untyped-def]
    """They are told, and the package is their cause."""
    old = {
        "arm/msg/Joint.msg": "float64 angle\n",
        "arm/setup.py": PYTHON,
        "arm/arm/__init__.py": "",
        "arm/arm/driver.py": "class Driver:\n    pass\n",
        "arm/README.md": "an arm\n",
    }
    moved = {
        "hand/package.xml": package("hand"),
        "hand/msg/Joint.msg": "float64 angle\n",
        "hand/setup.py": PYTHON.replace("arm", "hand"),
        "hand/hand/__init__.py": "",
        "hand/hand/driver.py": "class Driver:\n    def stop(self):\n        pass\n",
        "hand/README.md": "an arm\n",
    }
    found = [
        each for each in changes(old, {**moved, **dict.fromkeys(old), "arm/package.xml": None}) if each["breaking"]
    ]
    told = {(each["kind"], each["old"], each["new"]): each["cause"] for each in found}
    assert told[("message", "arm/msg/Joint", "hand/msg/Joint")] == "package arm"
    assert told[("file", "arm.driver", "hand.driver")] == "package arm"
    assert {cause for key, cause in told.items() if key[0] != "package"} == {"package arm"}


@pytest.mark.parametrize(
    ("before", "after", "breaks"),
    [
        ("text, **kwargs", "text, volume=1.0, **kwargs", False),
        ("text, **kwargs", "text, **kwargs", False),
        ("text, **kwargs", "text", True),
        ("text, **kwargs", "volume, text, **kwargs", True),
        ("text, voice='a'", "text, volume=1.0, voice='a'", True),
    ],
)
def test_arguments_before_those_that_take_any_name(told, before: str, after: str, breaks: bool) -> None:  # type: ignore[no-untyped-def]
    """`**kwargs` has no place that a new argument could take."""
    text = "class Voice:\n    def say(self, {}):\n        pass\n"
    old = {"arm/setup.py": PYTHON, "arm/arm/__init__.py": "", "arm/arm/voice.py": text.format(before)}
    assert bool(told(old, {"arm/arm/voice.py": text.format(after)})) is breaks


def test_a_script_that_catkin_installs_as_python_is_a_program(told) -> None:  # type: ignore[no-untyped-def]
    """`catkin_install_python` and `install(PROGRAMS)` install the same."""
    script = "#!/usr/bin/env python\nprint(1)\n"
    rest = "PROGRAMS scripts/say.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n"
    old = {"arm/CMakeLists.txt": f"project(arm)\ninstall({rest}", "arm/scripts/say.py": script}
    assert told(old, {"arm/CMakeLists.txt": f"project(arm)\ncatkin_install_python({rest}"}) == set()


def test_a_parameter_of_a_handed_handle_that_the_port_still_reads(told) -> None:  # type: ignore[no-untyped-def]
    """A node that declares what it is given reads it by its bare name."""
    ros1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")
    source = """#include <ros/ros.h>
#include <std_msgs/Bool.h>
int main(int c, char ** v) {
  ros::init(c, v, "arm");
  ros::NodeHandle nh;
  int rate;
  nh.param<int>("/rate", rate, 1);
  nh.advertise<std_msgs::Bool>("done", 1);
}
"""
    old = {"arm/package.xml": ros1, "arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": source}
    found = told(old, {"arm/package.xml": package("arm"), "arm/src/arm.cpp": node('get_parameter("rate", rate_);')})
    assert not [entry for entry in found if entry[0] == "parameter"]


def test_one_package_takes_the_place_of_one(told) -> None:  # type: ignore[no-untyped-def]
    """Where files of two packages moved to a new one, only one of them has become that."""
    names = [f"state_{number}" for number in range(4)]
    old: dict[str, str | None] = {}
    for robot in ("left", "right"):
        old[f"{robot}/package.xml"] = package(robot)
        old |= {f"{robot}/src/{name}.cpp": f"// {robot} {name}\nint {robot}_{name}();\n" for name in names}
    new: dict[str, str | None] = {"both/package.xml": package("both")}
    new |= {path.replace("left/src/", "both/src/left_"): text for path, text in old.items() if "left/src" in path}
    new |= {path.replace("right/src/", "both/src/right_"): text for path, text in old.items() if "right/src" in path}
    found = told(old, {**dict.fromkeys(old), **new})
    assert sum(entry[:2] == ("package", "renamed") for entry in found) == 1
