"""What the document of a system holds for values that JSON has no form for, and for what is not known."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from ecm_extract.cli.run import run
from ecm_extract.system.formats.json_values import json_value

MANIFEST = "<package format='3'><name>p</name><version>1.0.0</version></package>"


class _Marked(str):
    __slots__ = ()


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (math.inf, ".inf"),
        (-math.inf, "-.inf"),
        (math.nan, ".nan"),
        (1 << 63, str(1 << 63)),
        (-(1 << 63), -(1 << 63)),
        (True, True),
        (None, None),
        (_Marked("a"), "a"),
        ({1: [math.inf, (1, 2)]}, {"1": [".inf", [1, 2]]}),
        (b"x", "b'x'"),
    ],
)
def test_values(value: Any, expected: Any) -> None:
    """Nothing is lost, and nothing ends the run."""
    assert json.dumps(json_value(value)) == json.dumps(expected)
    assert type(json_value(value)) is type(expected)


@pytest.mark.parametrize("form", ["text", "json", "dot", "mermaid"])
def test_a_robot_whose_names_the_launch_decides(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Names with parts that are not known are written with braces in every format."""
    xacro = (
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="$(arg name)"><xacro:arg name="prefix"/>'
        '<link name="$(arg prefix)base"/><link name="${prefix}tip"/>'
        '<joint name="$(arg prefix)turn" type="fixed"><parent link="$(arg prefix)base"/><child link="tip"/></joint>'
        '<ros2_control name="$(arg prefix)arm" type="system"><hardware><plugin>$(arg plugin)</plugin></hardware>'
        '<joint name="$(arg prefix)turn"><command_interface name="$(arg mode)"/></joint></ros2_control></robot>'
    )
    launch = (
        '<launch><node pkg="robot_state_publisher" exec="robot_state_publisher"><param name="robot_description" '
        'value="$(command \'xacro $(find-pkg-share p)/r.urdf.xacro\')" type="str"/>'
        '<param name="far" value=".inf"/></node></launch>'
    )
    for name, text in {"package.xml": MANIFEST, "r.urdf.xacro": xacro, "a.launch.xml": launch}.items():
        (tmp_path / name).write_text(text)
    assert run(["system", "a.launch.xml", "--workspace", str(tmp_path), "--format", form, "--no-cache"]) == 0
    text = capsys.readouterr().out
    if form == "json":
        found = json.loads(text)
        assert [robot["name"] for robot in found["robots"]] == ["{name}"]
        assert [edge["parent"] for edge in found["frames"]] == ["{prefix}base"]
        assert {"far": ".inf"}.items() <= {e["name"]: e["value"] for e in found["nodes"][0]["parameters"]}.items()


def test_who_broadcasts_transforms(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A broadcaster publishes /tf, a listener reads it and /tf_static, and edges say what goes over them."""
    node = (
        "import rclpy\nfrom rclpy.node import Node\nfrom tf2_ros import Buffer, TransformBroadcaster, TransformListener\n"
        "class N(Node):\n    def __init__(self):\n        super().__init__('n')\n"
        "        self.out = TransformBroadcaster(self)\n        self.seen = TransformListener(Buffer(), self)\n"
        "def main():\n    rclpy.spin(N())\n"
    )
    setup = "from setuptools import setup\nsetup(name='p', entry_points={'console_scripts': ['n = p.n:main']})\n"
    launch = '<launch><node pkg="p" exec="n"/></launch>'
    (tmp_path / "p").mkdir()
    manifest = MANIFEST.replace("</package>", "<export><build_type>ament_python</build_type></export></package>")
    files = {"package.xml": manifest, "setup.py": setup, "p/__init__.py": "", "p/n.py": node, "a.launch.xml": launch}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert run(["system", "a.launch.xml", "--workspace", str(tmp_path), "--format", "mermaid", "--no-cache"]) == 0
    lines = [line.strip() for line in capsys.readouterr().out.splitlines() if "TFMessage" in line]
    assert lines == [
        'v0 -->|"tf2_msgs/msg/TFMessage"| v1',
        'v1 -->|"tf2_msgs/msg/TFMessage"| v0',
        'v2 -->|"tf2_msgs/msg/TFMessage"| v0',
    ]
