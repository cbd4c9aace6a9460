"""Messages that are renamed, and messages that went while others came."""

from __future__ import annotations

import pytest


@pytest.mark.parametrize(
    ("old", "new", "one"),
    [
        ("std_msgs/Header header\nPose[] poses\n", "std_msgs/Header header\nint32[] goods\n", False),
        ("std_msgs/Header header\nPose[] poses\n", "std_msgs/Header header\nPose[] poses\nint32 goods\n", True),
        ("float64 segId\n", "int32 segment_id\n", True),
        ("int32 posex\n", "float32 x\n", True),
        ("float64 a\n", "float64 value\n", True),
        ("uint8 OPEN=1\nuint8 grip\n", "uint8 OPEN=1\nint32 goods\n", True),
        ("", "int32 goods\n", True),
        ("Pose[] poses\nbool grip_ok\nstring grip_mode\n", "Pose[] poses\nint32 goods\nstring source\n", False),
        ("int32 a\nint32 b\nint32 c\nint32 grip_d\n", "int32 good_d\n", False),
        ("int32 a\nint32 b\nint32 grip_d\n", "int32 good_d\n", True),
        ("Pose[] poses\nbool grip_ok\nstring mode\n", "Pose[] poses\nbool good_ok\nint32 goods\n", True),
    ],
)
def test_a_message_of_another_name_has_something_of_the_old_one(told, old: str, new: str, one: bool) -> None:  # type: ignore[no-untyped-def]
    """Of two with names alike that share no field but the header, the one went and the other came."""
    before, after = "arm/msg/GripArray", "arm/msg/GoodArray"
    shared = {"arm/msg/Pose.msg": "float64 x\n"}
    found = told(
        {"arm/msg/GripArray.msg": old, **shared}, {"arm/msg/GripArray.msg": None, "arm/msg/GoodArray.msg": new}
    )
    messages = {each for each in found if each[0] == "message"}
    renamed = {("message", "renamed", before, after)}
    assert messages == (renamed if one else {("message", "removed", before, None), ("message", "added", None, after)})
    assert one or not {each for each in found if each[0] == "message_field"}


@pytest.mark.parametrize(("after", "one"), [("GripSet", True), ("ToolSet", False)])
def test_a_message_whose_name_lost_a_word_may_have_other_fields(told, after: str, one: bool) -> None:  # type: ignore[no-untyped-def]
    """All words of the new name are in the old one, which says more than that no field is."""
    old = {"arm/msg/ArmGripSet.msg": "float64 width\nint32 code\n"}
    found = told(old, {"arm/msg/ArmGripSet.msg": None, f"arm/msg/{after}.msg": "int32[] goods\n"})
    assert (("message", "renamed", "arm/msg/ArmGripSet", f"arm/msg/{after}") in found) is one


def test_a_message_that_holds_the_very_same_is_the_old_one(told) -> None:  # type: ignore[no-untyped-def]
    """However much more another new name is like the old one."""
    pin = "uint32 identifier\nint32 mode\n"
    new = {"arm/msg/Wrist_GpioConfig.msg": pin, "arm/msg/GpioPinConfig.msg": "uint32 pin_id\nbool output_mode\n"}
    found = told({"arm/msg/GpioConfig.msg": pin}, {"arm/msg/GpioConfig.msg": None, **new})
    assert {each for each in found if each[0] == "message"} == {
        ("message", "renamed", "arm/msg/GpioConfig", "arm/msg/Wrist_GpioConfig"),
        ("message", "added", None, "arm/msg/GpioPinConfig"),
    }
