"""Names that stand behind a branch which the default of their parameter does not take."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <ros/ros.h>
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh, pnh("~");
  int n, m; std::string mode;
  pnh.param("n", n, 0); pnh.param("m", m, 0); pnh.param<std::string>("mode", mode, "auto");
  std::string topic = "base";
  {body}
  auto pub = nh.advertise<std_msgs::String>(topic, 1);
}}
"""
ROWS = [
    ('if (n == 0) topic = "scan"; else topic = "scan" + std::to_string(n);', ["/scan", "/scan{n}"]),
    ('if (n > 0) { topic += std::to_string(n); }', ["/base", "/base{n}"]),
    ('if (mode != "auto") { topic = "base/" + mode; }', ["/base", "/base/{mode}"]),
    ('if (mode == "auto") { topic = "base/" + mode; }', ["/base", "/base/auto"]),
    ('if (n != 0 || ready()) { topic += std::to_string(n); }', ["/base", "/base0"]),
    ('if (n != 0 && ready()) { topic += std::to_string(n); }', ["/base", "/base{n}"]),
    ('if (n != 0 || m != 0) { topic += std::to_string(n); }', ["/base", "/base0"]),
    ('if (n != 0) { topic += std::to_string(m); }', ["/base", "/base0"]),
]  # fmt: skip


@pytest.mark.parametrize(("body", "names"), ROWS, ids=[row[0] for row in ROWS])
def test_a_default_is_none_behind_a_branch_that_it_does_not_take(workspace: Any, body: str, names: list[str]) -> None:
    """A run that comes there has the parameter set: to what, nobody knows; where another one may be set, it is open."""
    found = workspace.package({"src/demo.cpp": CPP.format(body=body)}, ros=1).interfaces()
    assert sorted(entry.name for entry in found if entry.role == "publisher") == names


def test_a_name_in_such_a_branch_is_open(workspace: Any) -> None:
    """A publisher of a branch, and the default of another parameter that is read there, in Python as well."""
    text = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String

rospy.init_node("demo")
count = rospy.get_param("~count", 1)
if count > 1:
    rospy.Publisher("out_%d" % count, String, queue_size=1)
    last = rospy.get_param("~last", count)
"""
    found = workspace.package({"scripts/demo.py": text}, ros=1).interfaces()
    assert [(one.name, one.confidence) for one in found if one.role == "publisher"] == [("/out_{count}", "pattern")]
    assert [one.default for one in found if one.name == "/demo/last"] == [None]
