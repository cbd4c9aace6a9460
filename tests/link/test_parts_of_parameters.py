"""Which ROS parameter gives a value, or a part of it, asked of the parts of the value."""

from __future__ import annotations

import pytest

from ecm_extract.link.running.values import Value, joined, literal, parameter, set_by

ODD = "a=b}{c"
"""A text that no pattern over the written form takes apart rightly."""


@pytest.mark.parametrize(
    ("groups", "written", "whole"),
    [
        ([set_by("topic", [literal("odom")])], "${topic=odom}", "topic"),
        ([set_by("topic", [literal(ODD)])], "${topic=a=b}{c}", "topic"),
        ([set_by("topic", [parameter("name")])], "${topic={name}}", "topic"),
        ([(literal(""),), set_by("topic", [literal("odom")])], "${topic=odom}", "topic"),
        ([(literal("/robot/"),), set_by("topic", [literal("odom")])], "/robot/${topic=odom}", ""),
        ([set_by("a", [literal("x")]), set_by("b", [literal("y")])], "${a=x}${b=y}", ""),
        ([(literal("${topic=odom}"),)], "${topic=odom}", ""),
    ],
)
def test_a_value_that_a_parameter_gives(groups: list[tuple[Value, ...]], written: str, whole: str) -> None:
    """A text that only looks like a parameter is a text."""
    (value,) = joined(groups)
    assert (value.written, value.parameter) == (written, whole)
