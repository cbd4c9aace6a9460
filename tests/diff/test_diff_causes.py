"""What one line does to several names, and to one name of several programs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import package, release, write
from ecm_checker.hub.provision import Provision
from ecm_checker.release import Change

from ecm_extract.cli.run import run
from ecm_extract.diff.causes import one_cause
from ecm_extract.diff.folding import folded
from ecm_extract.diff.model import Located, Pair
from ecm_extract.entities.side import Side

SETUP = "from setuptools import setup\nsetup(name='arm', packages=['arm'], scripts=['scripts/run'])\n"
NODE = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Run(Node):
    def __init__(self):
        super().__init__("run")
        for side in {sides}:
            self.create_publisher(String, "/" + side + "/cmd", 1)
        self.add("{first}")
        self.add("{second}")
    def add(self, place):
        self.create_service(Empty, "/" + place + "/reset", print)
rclpy.init()
rclpy.spin(Run())
"""
USER = """#!/usr/bin/env python3
import rclpy
from std_msgs.msg import String
node = rclpy.create_node("user")
node.create_subscription(String, "/{name}/cmd", print, 1)
"""


def _document(capsys: pytest.CaptureFixture[str], folder: Path, name: str, **after: object) -> dict[str, Any]:
    before = {"sides": ("left", "right", "rear"), "first": "base", "second": "tool"}
    for tag, words in (("1.0.0", before), ("2.0.0", {**before, **after})):
        files = {"package.xml": package("arm", tag), "setup.py": SETUP, "arm/__init__.py": ""}
        release(folder / "arm", {**files, "scripts/run": NODE.format(**words)}, tag)
    write(folder / "user", {"package.xml": package("user"), "scripts/user": USER.format(name=name)})
    run(["diff", "1.0.0", "2.0.0", "--repo", f"{folder}/arm", "--consumer", f"{folder}/user", "--format", "json"])
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize(
    ("after", "gone"),
    [
        ({"sides": ("left",)}, {"/right/cmd", "/rear/cmd"}),
        ({"sides": ("left", "right")}, {"/rear/cmd"}),
        ({"sides": ("left", "right", "rear")}, set()),
        ({"first": "tool"}, {"/base/reset"}),
    ],
)
def test_each_name_that_a_line_makes_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], after: dict[str, object], gone: set[str]
) -> None:
    """A round or a helper makes several names by one line, and each has users of its own."""
    changes = _document(capsys, tmp_path, "rear", **after)["changes"]
    assert {each["old"] for each in changes if each["change"] == "removed"} == gone


@pytest.mark.parametrize(("name", "broken"), [("right", True), ("rear", True), ("left", False)])
def test_who_uses_one_of_several_names_of_a_line_is_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, broken: bool
) -> None:
    """A name that goes with others by one line breaks its own users; one that stays breaks nobody."""
    assert bool(_document(capsys, tmp_path, name, sides=("left",))["findings"]) is broken


def _removed(old: Provision, value: str | None = None) -> Located:
    change = Change(
        kind=old.kind,
        change="removed",
        package=old.package,
        owner=old.owner,
        old=old.name,
        new=None,
        breaking=True,
        dimension="versioning",
        old_value=value,
    )
    return Located(change, Pair(old, None))


def _gone(owner: str, name: str = "rate", value: str | None = None) -> Located:
    place = {"path": "src/shared.cpp", "line": 7}
    return _removed(Provision(kind="parameter", package="arm", owner=owner, name=name, **place), value)  # type: ignore[arg-type]


def _program(name: str) -> Located:
    return _removed(Provision(kind="executable", package="arm", owner="", name=name, path="CMakeLists.txt", line=1))


@pytest.mark.parametrize(
    ("second", "told"),
    [(_gone("b"), 1), (_gone("b", "left.rate"), 2), (_gone("b", value="3"), 2), (_gone("a", "left.rate"), 2)],
)
def test_one_name_of_several_programs_is_one_change(second: Located, told: int) -> None:
    """Only what one line does to the very name, with the very values, is told once; the pairs of all are kept."""
    found = one_cause([_gone("a"), second], Side(None))
    assert len(found) == told
    owners = [each.pair.old.owner for entry in found for each in entry.each if each.pair.old is not None]
    assert owners == ["a", second.change.owner]


@pytest.mark.parametrize(("programs", "cause"), [(("a", "b"), True), (("a",), False)])
def test_what_one_of_its_programs_explains_is_not_explained(programs: tuple[str, ...], cause: bool) -> None:
    """A name of two programs is folded below what went only where both are gone."""
    joined = one_cause([_gone("a"), _gone("b")], Side(None))
    found = folded([*joined, *map(_program, programs)])
    assert [bool(each.change.cause) for each in found if each.change.kind == "parameter"] == [cause]


def test_ways_to_write_a_computed_name_are_one_change_that_names_them() -> None:
    """What a line makes of values that are not known is one change; each way is named, and asked for."""
    found = one_cause([_gone("a", "<*>/rate"), _gone("a", "left/<*>/rate"), _gone("a", "left/<*>/size")], Side(None))
    assert [len(list(entry.each)) for entry in found] == [2, 1]
    assert "(also left/<*>/rate)" in found[0].change.reason
