"""`check` and `system` over what could not be read as a whole: what was found holds, nothing is accepted."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from ecm_extract.cli.run import run

TALKER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from elsewhere import enlist


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.pub = self.create_publisher(String, "chatter", 10)
        {call}


def main():
    rclpy.init()
    rclpy.spin(Talker())
"""
LISTENER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import {type}


class Listener(Node):
    def __init__(self):
        super().__init__("listener")
        self.create_subscription({type}, "{topic}", print, 10)


def main():
    rclpy.init()
    rclpy.spin(Listener())
"""
LAUNCH = """<launch>
  <node pkg="{name}" exec="talker"/>
  <node pkg="{name}" exec="listener"/>
</launch>
"""
OUTSIDE = 'enlist(self, "state")'


def package(folder: Path) -> Path:
    """A package of two programs, called like its folder, with a launch file that starts both."""
    name = folder.name
    (folder / name).mkdir(parents=True)
    (folder / "launch").mkdir()
    (folder / "package.xml").write_text(
        f'<package format="3"><name>{name}</name><version>1.0.0</version><depend>rclpy</depend>'
        "<export><build_type>ament_python</build_type></export></package>"
    )
    programs = f'["talker = {name}.talker:main", "listener = {name}.listener:main"]'
    (folder / "setup.py").write_text(
        "from setuptools import setup\n"
        f'setup(name="{name}", packages=["{name}"], entry_points={{"console_scripts": {programs}}},\n'
        f'      data_files=[("share/{name}/launch", ["launch/both.launch.xml"])])\n'
    )
    (folder / name / "__init__.py").write_text("")
    (folder / "launch" / "both.launch.xml").write_text(LAUNCH.format(name=name))
    return folder


@pytest.fixture
def chat(tmp_path: Path) -> Path:
    """A package in a workspace of its own."""
    return package(tmp_path / "chat")


def written(folder: Path, call: str, topic: str = "chatter", type_name: str = "String") -> str:
    """The package with a talker that calls something beside, and a listener of a topic."""
    (folder / folder.name / "talker.py").write_text(TALKER.format(call=call))
    (folder / folder.name / "listener.py").write_text(LISTENER.format(topic=topic, type=type_name))
    return str(folder.parent)


def test_nothing_is_accepted_that_was_not_read(chat: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without a finding the outcome is a review with the file that is the cause, and the status 2."""
    whole = written(chat, "pass")
    assert run(["check", whole, "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out)["outcome"] == "accept"
    partly = written(chat, OUTSIDE)
    assert run(["check", partly, "--format", "json"]) == 2
    told = capsys.readouterr()
    document = json.loads(told.out)
    assert document["outcome"] == "review"
    assert [(each["path"], each["reason"]) for each in document["unread"]] == [("chat/chat/talker.py", "outside")]
    assert "not read: 1 file(s) that give a node" in told.err


def test_what_was_found_holds_all_the_same(chat: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Two types on one topic are wrong whatever else there is: rejected, with status 1."""
    partly = written(chat, OUTSIDE, type_name="Int32")
    assert run(["check", partly, "--together", "--format", "json"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["outcome"] == "reject"
    assert [(each["rule"], each["certainty"]) for each in document["findings"]] == [("SIG001", "proved")]


def test_what_nobody_gives_may_be_in_what_was_not_read(chat: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A near name without a publisher is a doubt where a file was not read."""
    assert run(["check", written(chat, "pass", topic="chater"), "--format", "json"]) == 0
    (before,) = json.loads(capsys.readouterr().out)["findings"]
    assert run(["check", written(chat, OUTSIDE, topic="chater"), "--format", "json"]) == 2
    (after,) = json.loads(capsys.readouterr().out)["findings"]
    assert before["rule"] == after["rule"] == "SIG005"
    assert before["certainty"] != "unknown"
    assert after["certainty"] == "unknown"
    assert after["message"].startswith("in what could be read: ")


@pytest.mark.parametrize(
    "command",
    [["check", "{}", "--launch", "chat/both.launch.xml"], ["system", "--workspace", "{}", "chat/both.launch.xml"]],
)
def test_a_launch_tells_what_was_not_read_of_its_nodes(
    chat: Path, command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """Nodes of a launch have the gaps of their packages."""
    assert run([word.format(written(chat, "pass")) for word in command]) == 0
    capsys.readouterr()
    assert run([word.format(written(chat, OUTSIDE)) for word in command]) == 2
    assert "chat/chat/talker.py" in capsys.readouterr().err


def test_what_no_started_node_needs_may_be_unread(chat: Path) -> None:
    """A package beside those that run costs a launch nothing."""
    written(package(chat.parent / "beside"), OUTSIDE)
    tree = written(chat, "pass")
    assert run(["extract", tree, "--format", "summary"]) == 2
    assert run(["system", "--workspace", tree, "chat/both.launch.xml"]) == 0


def test_an_upgrade_needs_both_sides_as_a_whole(chat: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a side seems to lack may be unread."""
    tree = written(chat, OUTSIDE)
    assert run(["check", "upgrade", tree, tree]) == 2
    assert "could not be read as a whole" in capsys.readouterr().err


def test_a_launch_tells_of_folders_that_may_hold_its_packages(
    chat: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A node of a package that the tree does not show may be of one in a folder that could not be listed."""
    tree = written(chat, "pass")
    (chat / "launch" / "both.launch.xml").write_text('<launch><node pkg="hidden" exec="driver"/></launch>')
    assert run(["system", "--workspace", tree, "chat/both.launch.xml"]) == 0
    (chat.parent / "drivers").mkdir()
    listed = os.scandir

    def scandir(path: Path) -> Any:
        if Path(path).name == "drivers":
            raise PermissionError(13, "Permission denied")
        return listed(path)

    monkeypatch.setattr(os, "scandir", scandir)
    capsys.readouterr()
    assert run(["system", "--workspace", tree, "chat/both.launch.xml"]) == 2
    assert "not read: 1 file(s) or folder(s) without permission, or cut off: drivers" in capsys.readouterr().err
