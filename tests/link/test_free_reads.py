"""Functions and methods with two arguments that write a parameter to a variable."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
#include <std_msgs/Bool.h>
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh, pnh("~");
  std::string topic{begun};
  {read}
  ros::Publisher pub = nh.advertise<std_msgs::Bool>(topic + "/state", 1);
}}
"""
WRITE = [
    'ros::param::get("~topic", topic);',
    'ros::param::getCached("~topic", topic);',
    'pnh.getParam("topic", topic);',
    'pnh.getParamCached("topic", topic);',
    'bool found = ros::param::get("~topic", topic);',
]
RETURN = ['std::string other = ros::param::param<std::string>("~topic", topic);']


@pytest.mark.parametrize("read", WRITE)
def test_what_a_read_without_default_writes_is_the_parameter(workspace: Any, read: str) -> None:
    """A variable that a parameter is read into is never what it began with as proved: whoever sets it decides."""
    found = workspace.package({"src/d.cpp": TEXT.format(begun="", read=read)}, ros=1).only("publisher")
    assert (found.name, found.confidence) == ("/{topic}/state", "pattern")
    begun = workspace.package({"src/d.cpp": TEXT.format(begun=' = "a"', read=read)}, ros=1).only("publisher")
    assert (begun.name, begun.confidence) == ("/a/state", "default")


@pytest.mark.parametrize("read", RETURN)
def test_a_default_is_read_and_not_written_to(workspace: Any, read: str) -> None:
    """The second of two arguments of what returns the parameter is its default, and stays what it is."""
    found = workspace.package({"src/d.cpp": TEXT.format(begun=' = "a"', read=read)}, ros=1).only("publisher")
    assert (found.name, found.confidence) == ("/a/state", "folded")
