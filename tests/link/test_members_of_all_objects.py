"""Static members of C++ that methods of their class change: the next object finds what the last one left."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
#include <std_msgs/String.h>
struct Part {{
  static int count;
  int id;
  Part() {made}
  {more}
  std::string name() const {{ return "part_" + std::to_string({read}); }}
}};
int Part::count = 0;
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  Part first, second;
  nh.advertise<std_msgs::String>(second.name(), 1);
}}
"""
OPEN = [
    (": id(count++) {}", "", "id"),
    ("{ id = count; ++count; }", "", "id"),
    (": id(count) {}", "void next() { count += 1; }", "id"),
    (": id(0) {}", "void next() { count = 7; }", "count"),
]


@pytest.mark.parametrize(("made", "more", "read"), OPEN)
def test_what_methods_change_for_all_objects_is_open(workspace: Any, made: str, more: str, read: str) -> None:
    """What a static member is defined with is what the first object finds, and proves nothing of the others."""
    text = TEXT.format(made=made, more=more, read=read)
    found = workspace.package({"src/d.cpp": text}, ros=1).interfaces()
    told = {entry.confidence for entry in found if entry.role == "publisher"}
    assert told
    assert not told & {"folded", "literal"}


def test_what_nobody_changes_is_what_it_is_defined_with(workspace: Any) -> None:
    """A static member that methods only read is as it is defined."""
    text = TEXT.format(made=": id(count) {}", more="int asked() const { return count; }", read="id")
    found = workspace.package({"src/d.cpp": text}, ros=1).only("publisher")
    assert (found.name, found.confidence) == ("/part_0", "folded")
