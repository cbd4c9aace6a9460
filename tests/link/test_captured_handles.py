"""Handles that lambdas capture: what is read and subscribed to with them, and of which type."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
#include <std_msgs/Bool.h>
void heard(const std_msgs::BoolConstPtr & message) {{}}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh, pnh("~");
  double value;
  bool good = true;
  {lambda_}
  read("rate", value);
}}
"""
READS = [
    "auto read = [&pnh](const std::string & key, double & out) { pnh.getParam(key, out); };",
    "auto read = [&](const std::string & key, double & out) { good = good && pnh.getParam(key, out); };",
    "auto read = [&](const std::string & key, auto & out) { pnh.getParam(key, out); };",
    "auto read = [own = pnh](const std::string & key, double & out) { own.getParam(key, out); };",
    "auto read = [&](const std::string & key, double & out) { auto in = [&] { pnh.getParam(key, out); }; in(); };",
]


@pytest.mark.parametrize("lambda_", READS)
def test_a_lambda_reads_with_the_handle_that_it_captures(workspace: Any, lambda_: str) -> None:
    """A lambda knows the type of what it captures, and `auto` of a parameter is the type of what it is given."""
    found = workspace.package({"src/d.cpp": TEXT.format(lambda_=lambda_).replace("{lambda_}", "")}, ros=1)
    parameter = found.only("parameter")
    assert (parameter.name, parameter.type) == ("/demo/rate", "double")


def test_a_lambda_subscribes_with_the_handle_that_it_captures(workspace: Any) -> None:
    """A method of a captured handle is a row of the tables as outside of the lambda."""
    make = "auto read = [&](const std::string & key, double & out) { nh.subscribe(key, 1, heard); };"
    found = workspace.package({"src/d.cpp": TEXT.format(lambda_=make)}, ros=1).only("subscriber")
    assert (found.name, found.type) == ("/rate", "std_msgs/msg/Bool")


def test_a_variable_of_a_lambda_hides_the_one_around_it(workspace: Any) -> None:
    """What a lambda declares itself is of its own type, whatever is called alike around it."""
    hidden = "auto read = [&](const std::string & key, double & out) { Settings pnh; pnh.getParam(key, out); };"
    text = "struct Settings { bool getParam(const std::string &, double &); };" + TEXT.format(lambda_=hidden)
    found = workspace.package({"src/d.cpp": text}, ros=1).interfaces()
    assert not [each for each in found if each.role == "parameter"]
