"""Types of parameters that a node of ROS 1 sets: those of what it gives them."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
#include <ros/ros.h>
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "n");
  ros::NodeHandle nh;
  double gain; XmlRpc::XmlRpcValue whatever;
  {change}
  ros::spin();
}}
"""
ROWS = [
    ("a truth value", 'nh.setParam("a", true);', "bool"),
    ("a number", 'nh.setParam("a", 3);', "integer"),
    ("a variable", 'nh.setParam("a", gain);', "double"),
    ("without a handle", 'ros::param::set("a", false);', "bool"),
    ("anything", 'nh.setParam("a", whatever);', None),
    ("also read for another type", 'nh.setParam("a", 3); nh.getParam("a", gain);', "double"),
    ("also read with a default", 'nh.param("a", gain, 0.5); nh.setParam("a", 3);', "double"),
]


@pytest.mark.parametrize(("change", "kind"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_parameter_that_is_set_has_the_type_of_what_it_gets(workspace: Any, change: str, kind: str | None) -> None:
    """What it is set to is no default of it, and who reads it says more of its type."""
    found = workspace.package({"src/n.cpp": SOURCE.format(change=change)}, ros=1).only("parameter")
    assert found.type == kind
    assert found.default == (0.5 if "param(" in change else None)
