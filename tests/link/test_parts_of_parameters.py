"""Which ROS parameter gives a value, or a part of it, asked of the parts of the value."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.hub.local_name import LocalName, OpenPart, Parts

from ecm_extract.link.naming.filling import filled
from ecm_extract.link.naming.handle import OWN, Handle
from ecm_extract.link.naming.local_names import local_name, local_parameter, parts_of
from ecm_extract.link.running.own_names import node_name, node_namespace
from ecm_extract.link.running.values import (
    Value,
    joined,
    literal,
    parameter,
    set_by,
    settled,
    unknown,
)

ODD = "a=b}{c"
"""A text that no pattern over one text takes apart rightly."""
ODOM = OpenPart("parameter", "topic", ("odom",))


@pytest.mark.parametrize(
    ("groups", "parts", "whole"),
    [
        ([set_by("topic", [literal("odom")])], (ODOM,), "topic"),
        ([set_by("topic", [literal(ODD)])], (OpenPart("parameter", "topic", (ODD,)),), "topic"),
        (
            [set_by("topic", [parameter("name")])],
            (OpenPart("parameter", "topic", (OpenPart("caller", "name"),)),),
            "topic",
        ),
        ([(literal(""),), set_by("topic", [literal("odom")])], (ODOM,), "topic"),
        ([(literal("/robot/"),), set_by("topic", [literal("odom")])], ("/robot/", ODOM), ""),
        ([(unknown("robot"),), set_by("topic", [literal("odom")])], (OpenPart("nobody", "robot"), ODOM), ""),
        ([set_by("a", [literal("x")]), set_by("b", [literal("y")])],
         (OpenPart("parameter", "a", ("x",)), OpenPart("parameter", "b", ("y",))), ""),
        ([(literal("${topic=odom}"),)], ("${topic=odom}",), ""),
    ],
)  # fmt: skip
def test_a_value_that_a_parameter_gives(groups: list[tuple[Value, ...]], parts: Parts, whole: str) -> None:
    """A text that only looks like a parameter is a text."""
    (value,) = joined(groups)
    assert (parts_of(value), value.parameter) == (parts, whole)


def test_what_makers_give_by_default_is_so_in_what_a_parameter_gives() -> None:
    (value,) = set_by("topic", [parameter("name", made=True, default="scan")])
    assert parts_of(settled(value)) == (OpenPart("parameter", "topic", ("scan",)),)


@pytest.mark.parametrize(
    ("given", "texts"),
    [
        (None, ["/base/odom"]),
        ("${a=b}", ["/base/${a=b}"]),
        (["x", "y", {"no": "text"}], ["/base/x", "/base/y"]),
        ([], ["/base/odom"]),
    ],
)
def test_what_a_parameter_gives_is_put_in_as_it_stands(given: object, texts: list[str]) -> None:
    """A value that looks like another parameter is a text; a list gives a name for each item."""
    assert filled(("/base/", ODOM), {"topic": given}.get) == [("/base/", text.removeprefix("/base/")) for text in texts]


@pytest.mark.parametrize(
    ("value", "handle", "node", "name"),
    [
        (literal("out"), OWN, "here", LocalName(("out",))),
        (literal("out"), OWN, "arm/here", LocalName(("out",), "arm")),
        (literal("{in arm}out"), OWN, "here", LocalName(("{in arm}out",))),
        (literal("~/out"), OWN, "arm/here", LocalName(("~/out",), "arm")),
        (literal("/out"), OWN, "arm/here", LocalName(("/out",))),
        (literal("out"), OWN, "{robot}/here", LocalName(("{robot}/out",))),
        (literal("out"), Handle(literal("~")), None, LocalName(("~/out",))),
        (literal("~/out"), Handle(literal(""), literal("arm/other")), None, LocalName(("other/out",), "arm")),
        (*set_by("topic", [literal("odom")]), Handle(literal("base")), None, LocalName(("base/", ODOM))),
        (joined([(node_name(),), (literal("/out"),)])[0], OWN, "arm/here", LocalName(("~/out",), "arm")),
        (*set_by("topic", joined([(node_name(),), (literal("/out"),)])), OWN, "arm/here",
         LocalName((OpenPart("parameter", "topic", (OpenPart("node"), "/out")),), "arm")),
        (joined([set_by("own", [node_name()]), (literal("/out"),)])[0], OWN, "arm/here",
         LocalName((OpenPart("parameter", "own", (OpenPart("node"),)), "/out"), "arm")),
        (joined([(node_namespace(),), (literal("/out"),)])[0], OWN, "arm/here",
         LocalName((OpenPart("namespace"), "/out"))),
    ],
)  # fmt: skip
def test_a_name_for_any_namespace_and_node(value: Value, handle: Handle, node: str | None, name: LocalName) -> None:
    """The namespace that code gives a node stands beside the name, so that a text never means more than it says."""
    assert local_name(value, handle, node) == name


def test_a_parameter_is_below_the_prefix_of_its_node() -> None:
    """ROS 2 puts a dot between them, ROS 1 a slash."""
    below = Handle(literal("arm"))
    assert local_parameter(literal("rate"), below, 2) == LocalName(("arm.rate",))
    assert local_parameter(literal("rate"), below, 1) == LocalName(("arm/rate",))


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


OWN_BY_DEFAULT = """
#include <rclcpp/rclcpp.hpp>
class Reader : public rclcpp::Node {
 public:
  Reader() : Node("reader") {
    declare_parameter("from", get_name() + std::string("/cloud"));
    get_parameter("from", from_);
    sub_ = create_subscription<std_msgs::msg::String>(from_, 1, [](std_msgs::msg::String::SharedPtr) {});
  }
  std::string from_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr sub_;
};
int main() { rclcpp::spin(std::make_shared<Reader>()); }
"""


def test_a_parameter_that_is_below_the_name_of_the_node_by_default(workspace: Any) -> None:
    """The whole name is the parameter's: nothing of it stands below the node where somebody sets it."""
    found = workspace.package({"src/n.cpp": OWN_BY_DEFAULT}, ros=2).only("subscriber")
    assert (found.name, found.confidence) == ("/reader/cloud", "default")
