"""What the nodes of a system ask of each other."""

from __future__ import annotations

import json
from typing import Any

import pytest
from workspaces import Workspace

from ecm_extract.cli.run import run

NODE = """import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import {type}


class {cls}(Node):
    def __init__(self):
        super().__init__("{name}")
        {body}


def main():
    rclpy.init()
    rclpy.spin({cls}())
"""
SETUP = """from setuptools import setup
setup(name="pkg", entry_points={"console_scripts": [
    "mouth = pkg.mouth:main", "ear = pkg.ear:main"]})
"""
LAUNCH = """<launch>
  <arg name="loud" default="true"/>
  <node pkg="pkg" exec="mouth" name="mouth" {mouth}/>
  <node pkg="pkg" exec="ear" name="ear" {ear}/>
  {more}
</launch>
"""
INCLUDE = '<include file="$(find-pkg-share other)/launch/more.launch.xml"/>'
PLUGGED = '<node pkg="pkg" exec="mouth" name="more"><param name="layer" value="other::Layer"/></node>'
SPEAKS = 'self.pub = self.create_publisher({type}, "word", QoSProfile(depth=1, reliability={level}))'
HEARS = 'self.sub = self.create_subscription({type}, "word", print, QoSProfile(depth=1, reliability={level}))'
RELIABLE, BEST_EFFORT = "ReliabilityPolicy.RELIABLE", "ReliabilityPolicy.BEST_EFFORT"


def python(name: str, body: str, kind: str) -> str:
    return NODE.format(type=kind, cls=name.title(), name=name, body=body)


def asked(
    workspace: Workspace, capsys: pytest.CaptureFixture[str], files: dict[str, str], **launch: str
) -> list[dict[str, Any]]:
    text = LAUNCH.format(**{"mouth": "", "ear": "", "more": "", **launch})
    sources = {"package.xml": "", "setup.py": SETUP, "pkg/__init__.py": "", "launch/a.launch.xml": text, **files}
    workspace.package(sources, 2)
    run(["system", "pkg/a.launch.xml", "--workspace", str(workspace.root), "--format", "json", "--no-cache"])
    return [each for each in json.loads(capsys.readouterr().out)["connections"] if each["use"] == "hears"]


def nodes(
    spoken: str = "String", heard: str = "String", offered: str = RELIABLE, wanted: str = RELIABLE
) -> dict[str, str]:
    return {
        "pkg/mouth.py": python("mouth", SPEAKS.format(type=spoken, level=offered), spoken),
        "pkg/ear.py": python("ear", HEARS.format(type=heard, level=wanted), heard),
    }


@pytest.mark.parametrize(
    ("files", "launch", "state", "breach"),
    [
        (nodes(), {}, "met", None),
        (nodes(heard="Bool"), {}, "incompatible", "type"),
        (nodes(offered=BEST_EFFORT), {}, "incompatible", "qos"),
        (nodes(), {"ear": 'namespace="left"'}, "dangling", None),
        (nodes(), {"ear": 'namespace="left"', "more": '<node pkg="other" exec="other"/>'}, "unknown", None),
        (nodes(), {"ear": 'namespace="left"', "more": '<node pkg="rviz2" exec="rviz2"/>'}, "dangling", None),
        (nodes(), {"ear": 'namespace="left"', "more": '<executable cmd="other --fast"/>'}, "unknown", None),
        (nodes(), {"ear": 'namespace="left"', "more": INCLUDE}, "unknown", None),
        (nodes(), {"ear": 'namespace="left"', "more": PLUGGED}, "unknown", None),
    ],
)
def test_states(
    workspace: Workspace,
    capsys: pytest.CaptureFixture[str],
    files: dict[str, str],
    launch: dict[str, str],
    state: str,
    breach: str | None,
) -> None:
    (found,) = asked(workspace, capsys, files, **launch)
    assert (found["node"].rpartition("/")[2], found["state"], found["breach"]) == ("ear", state, breach)


def test_a_condition_that_nothing_decides_is_told(workspace: Workspace, capsys: pytest.CaptureFixture[str]) -> None:
    (found,) = asked(workspace, capsys, nodes(), mouth='if="$(env LOUD)"')
    assert found["state"] == "met"
    assert found["conditions"] == ["env LOUD"]


def test_an_argument_that_decides_against_a_node(workspace: Workspace, capsys: pytest.CaptureFixture[str]) -> None:
    (found,) = asked(workspace, capsys, nodes(), mouth='unless="$(var loud)"')
    assert found["state"] == "dangling"
    assert found["with"] == []


def test_the_text_tells_what_does_not_fit(workspace: Workspace, capsys: pytest.CaptureFixture[str]) -> None:
    asked(workspace, capsys, nodes(heard="Bool"))
    run(["system", "pkg/a.launch.xml", "--workspace", str(workspace.root), "--no-cache"])
    text = capsys.readouterr().out
    assert "does not fit" in text
    assert "/ear subscribes to /word: another type than of /mouth" in text
