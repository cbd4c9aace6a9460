"""What two sides of a message compare: order, types and names of fields, in ROS 1 constants as well."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import package, release, write

from ecm_extract.cli.run import run

ROS1 = (
    '<package format="2"><name>{}</name><version>1.0.0</version><description>d</description>'
    "<maintainer email='a@b.c'>m</maintainer><license>MIT</license><buildtool_depend>catkin</buildtool_depend>"
    "<depend>message_generation</depend></package>\n"
)
MANIFESTS = {1: ROS1.format("arm"), 2: package("arm")}
USER = """#!/usr/bin/env python3
import rospy
from arm.msg import {name}
rospy.init_node("user")
publisher = rospy.Publisher("/sent", {name}, queue_size=1)
sent = {name}()
{rest}
"""


def _document(
    capsys: pytest.CaptureFixture[str], folder: Path, ros: int, old: dict[str, str], new: dict[str, str], *user: str
) -> dict[str, Any]:
    files: dict[str, str | None] = dict.fromkeys((f"msg/{name}.msg" for name in old.keys() - new.keys()), None)
    for tag, side in (("1.0.0", old), ("2.0.0", new)):
        messages = {f"msg/{name}.msg": text for name, text in side.items()}
        gone = files if tag == "2.0.0" else {}
        release(folder / "arm", {"package.xml": MANIFESTS[ros], **messages, **gone}, tag)
    arguments = ["diff", "1.0.0", "2.0.0", "--repo", f"{folder}/arm", "--format", "json"]
    if user:
        files = {"package.xml": ROS1.format("user"), "scripts/user": USER.format(name=user[0], rest=user[1])}
        write(folder / "user", files)
        arguments += ["--consumer", f"{folder}/user"]
    run(arguments)
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def _told(document: dict[str, Any]) -> set[tuple[str, str, str, bool]]:
    return {
        (each["kind"], each["change"], each["old"] or each["new"], each["breaking"]) for each in document["changes"]
    }


OTHERWISE = ("message", "signature_changed", "arm/msg/A", True)
HOLDS = ("message", "signature_changed", "arm/msg/B", True)


@pytest.mark.parametrize("ros", [1, 2])
@pytest.mark.parametrize(
    ("new", "told"),
    [
        ("int32 b\nint32 a\n", {OTHERWISE, HOLDS}),
        ("# turned\nint32   a  # said\n\nint32 b\n", set()),
        ("int32 b\nint32 a\nint32 c\n", {("message_field", "added", "c", True), HOLDS}),
    ],
)
def test_fields_in_another_order_are_another_type(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], ros: int, new: str, told: set[tuple[str, str, str, bool]]
) -> None:
    """Who was built before reads the one as the other; where a field is new as well, that change tells of both."""
    old = {"A": "int32 a\nint32 b\n", "B": "A[] all\n"}
    assert _told(_document(capsys, tmp_path, ros, old, {**old, "A": new})) == told


def _constant(change: str, breaking: bool) -> set[tuple[str, str, str, bool]]:
    return {("constant", change, "X", breaking)}


@pytest.mark.parametrize(
    ("ros", "old", "new", "told"),
    [
        (1, "", "uint8 X=1\n", {*_constant("added", True), HOLDS}),
        (2, "", "uint8 X=1\n", _constant("added", False)),
        (1, "uint8 X=1\n", "", {*_constant("removed", True), HOLDS}),
        (2, "uint8 X=1\n", "", _constant("removed", True)),
        (1, "uint8 X=1\n", "uint8 X=2\n", {*_constant("default_changed", True), HOLDS}),
        (2, "uint8 X=1\n", "uint8 X=2\n", _constant("default_changed", True)),
        (1, "uint8 X=1\nuint8 Y=2\n", "uint8 Y=2\nuint8 X=1\n", {OTHERWISE, HOLDS}),
        (2, "uint8 X=1\nuint8 Y=2\n", "uint8 Y=2\nuint8 X=1\n", set()),
    ],
)
def test_constants_are_in_the_sum_of_ros_1(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    ros: int,
    old: str,
    new: str,
    told: set[tuple[str, str, str, bool]],
) -> None:
    """One more, less or otherwise is another MD5 sum, of what holds the type too; the hash of ROS 2 has none."""
    before = {"A": f"{old}int32 a\n", "B": "A held\n"}
    found = _document(capsys, tmp_path, ros, before, {**before, "A": f"{new}int32 a\n"})
    assert _told(found) == told
    assert all(("MD5" in each["reason"]) == (ros == 1) for each in found["changes"])


@pytest.mark.parametrize(
    ("rest", "severity"), [("", {"info"}), ("sent.a = A.X", {"error"}), ("sent.a = A.Y", {"info"})]
)
def test_who_has_a_type_whose_constant_is_gone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], rest: str, severity: set[str]
) -> None:
    """Who names the constant breaks; who only has the type must be built anew."""
    old = {"A": "uint8 X=1\nuint8 Y=2\nint32 a\n"}
    found = _document(capsys, tmp_path, 1, old, {"A": "uint8 Y=2\nint32 a\n"}, "A", rest)["findings"]
    assert {each["severity"] for each in found} == severity


@pytest.mark.parametrize(
    ("new", "words"),
    [
        ({"Part": "int32 x\n", "A": "Part p\n"}, "stay the same"),
        ({"Part": "int32 x\nint32 y\n", "A": "Part p\n"}, "connections are refused"),
        ({"Part": "int32 x\n", "A": "Part[] p\n"}, "read each other's bytes wrongly"),
    ],
)
def test_a_type_of_another_name_says_what_its_bytes_are(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], new: dict[str, str], words: str
) -> None:
    """Only its name may be another one, which ROS 1 does not compare; so is whether it is an array of types."""
    found = _document(capsys, tmp_path, 1, {"part": "int32 x\n", "A": "part p\n"}, new)["changes"]
    assert [words in each["reason"] for each in found if each["kind"] == "message_field" and each["old"] == "p"] == [
        True
    ]


@pytest.mark.parametrize(
    ("ros", "held", "told"),
    [(1, "int32 x\n", False), (1, "int32 x\nint32 y\n", True), (2, "int32 x\n", True)],
)
def test_who_holds_what_holds_a_type_of_another_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], ros: int, held: str, told: bool
) -> None:
    """ROS 2 compares the names of types as well; in ROS 1 only the message whose own text names it has changed."""
    old = {"part": "int32 x\n", "A": "part p\n", "B": "A a\n"}
    found = _document(capsys, tmp_path, ros, old, {"Part": held, "A": "Part p\n", "B": "A a\n"})
    assert {each["old"] for each in found["changes"] if each["change"] == "signature_changed"} == (
        {"arm/msg/B"} if told else set()
    )
