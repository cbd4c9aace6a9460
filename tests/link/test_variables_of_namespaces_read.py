"""Variables of namespaces that functions read parameters into, and others take as names."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <ros/ros.h>
#include <std_msgs/String.h>
std::string topic{value};
{first}
class Second {{
 public:
  explicit Second(ros::NodeHandle & nh) {{ pub_ = nh.advertise<std_msgs::String>(topic, 1); }}
  ros::Publisher pub_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "n"); ros::NodeHandle nh; {make} Second second(nh); ros::spin(); }}
"""
CLASS = "class First { public: explicit First(ros::NodeHandle & nh) { %s } };"
FUNCTION = "void load(ros::NodeHandle & nh) { %s }"
READ = 'nh.param<std::string>("topic", topic, "/set");'


@pytest.mark.parametrize(("first", "make"), [(CLASS, "First first(nh);"), (FUNCTION, "load(nh);")])
def test_a_variable_without_a_value_is_what_is_read_into_it(workspace: Any, first: str, make: str) -> None:
    """`std::string topic;` is no name before somebody gives it one."""
    text = CPP.format(value="", first=first % READ, make=make)
    found = workspace.package({"src/n.cpp": text}, ros=1).only("publisher")
    assert (found.name, found.confidence) == ("/set", "default")


def test_a_variable_with_a_value_may_be_either(workspace: Any) -> None:
    """Who reads first is not known: the value of its declaration was told, as proved."""
    text = CPP.format(value=' = "/begun"', first=CLASS % READ, make="First first(nh);")
    found = workspace.package({"src/n.cpp": text}, ros=1).interfaces()
    told = {(each.name, each.confidence) for each in found if each.role == "publisher"}
    assert told == {("/begun", "one_of"), ("/set", "one_of")}


def test_a_variable_that_is_assigned_something_else_is_not_told(workspace: Any) -> None:
    """What a function makes of what was there before depends on when it runs."""
    text = CPP.format(value="", first=CLASS % 'topic += "x";', make="First first(nh);")
    found = workspace.package({"src/n.cpp": text}, ros=1).only("publisher")
    assert found.confidence == "pattern"
