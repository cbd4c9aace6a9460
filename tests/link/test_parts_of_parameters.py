"""Which ROS parameter gives a value, or a part of it, asked of the parts of the value."""

from __future__ import annotations

from typing import Any

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


TALKER = """
#include <ros/ros.h>
int main(int c, char ** v) {{
  ros::init(c, v, "n");
  ros::NodeHandle nh("~");
  std::string given;
  nh.param<std::string>("given", given, "{default}");
  ros::Publisher p = nh.advertise<std_msgs::String>({name}, 1);
}}
"""


@pytest.mark.parametrize(
    ("default", "name", "told"),
    [
        ("", 'given + "/out"', ("/out", "default")),
        ("", 'given + "out"', ("/n/out", "default")),
        ("", "given", ("/n/{given}", "pattern")),
        ("a", 'given + "/out"', ("/n/a/out", "default")),
    ],
)
def test_a_part_that_is_empty_unless_somebody_sets_it(
    workspace: Any, default: str, name: str, told: tuple[str, str]
) -> None:
    """A prefix that is empty by default puts nothing before a name; a name that is nothing else has to be set."""
    found = workspace.package({"src/n.cpp": TALKER.format(default=default, name=name)}, ros=1).only("publisher")
    assert (found.name, found.confidence) == told


def test_a_part_that_a_source_asks_for_first_stays_open(workspace: Any) -> None:
    """Where something else stands in for an empty prefix, it is not empty where it stands itself."""
    body = "if (given.empty()) { given = host(); }\n  ros::Publisher p = nh.advertise"
    text = TALKER.format(default="", name='"at_" + given').replace("ros::Publisher p = nh.advertise", body)
    workspace.package({"src/n.cpp": text}, ros=1)
    found = {entry.name for entry in workspace.interfaces() if entry.role == "publisher"}
    assert found == {"/n/at_{given}", "/n/at_{host}"}
