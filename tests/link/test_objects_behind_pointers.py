"""Objects of C++ behind a pointer that a function is handed: what it writes to their fields counts behind the call."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
#include <std_msgs/String.h>
struct Config {{ std::string topic = "own"; }};
{function}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  Config * config = new Config();
  work(nh, config);
  nh.advertise<std_msgs::String>(config->topic, 1);
}}
"""
WRITES = [
    'void work(ros::NodeHandle & nh, Config * c) { c->topic = "other"; }',
    'void work(ros::NodeHandle & nh, Config * c) { nh.getParam("topic", c->topic); }',
    'void work(ros::NodeHandle & nh, Config * c) { if (nh.ok()) c->topic += "_more"; }',
]
READS = [
    'void work(ros::NodeHandle & nh, Config * c) { ROS_INFO("%s", c->topic.c_str()); }',
    "void work(ros::NodeHandle & nh, const Config * c) { nh.ok(); }",
]


@pytest.mark.parametrize("function", WRITES)
def test_what_a_function_writes_is_not_what_was_there(workspace: Any, function: str) -> None:
    """A field that a function may write by its pointer is never told as it was made, as proved."""
    found = workspace.package({"src/d.cpp": TEXT.format(function=function)}, ros=1).interfaces()
    told = {(entry.name, entry.confidence) for entry in found if entry.role == "publisher"}
    assert told
    assert not told & {("/own", "folded"), ("/own", "literal")}


@pytest.mark.parametrize("function", READS)
def test_what_a_function_only_reads_stays(workspace: Any, function: str) -> None:
    """Who only looks at the object leaves it as it is."""
    found = workspace.package({"src/d.cpp": TEXT.format(function=function)}, ros=1).only("publisher")
    assert (found.name, found.confidence) == ("/own", "folded")
