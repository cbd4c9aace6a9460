"""Handles of objects that nobody hands over: of a class of which the tree makes one object it is that one's."""

from __future__ import annotations

from typing import Any

import pytest

SETTINGS = """
#include <ros/ros.h>
class Settings {{
 public:
  Settings(ros::NodeHandle & handle) : handle_(handle) {{ instance_ = this; }}
  template<typename T> static T get(const std::string & name, const T & otherwise) {{
    T value;
    if (!instance_->handle_.getParamCached(name, value)) {{ value = otherwise; }}
    return value;
  }}
 private:
  ros::NodeHandle handle_;
  static Settings * instance_;
}};
Settings * Settings::instance_ = NULL;
{more}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle own("~");
  {made}
  ros::spin();
}}
"""
FRONT = """
class Front {
 public:
  Front(ros::NodeHandle & own) : settings_(own) { rate_ = Settings::get<double>("rate", 5.0); }
  double rate_;
  Settings settings_;
};
"""
MINE = "struct Mine : Settings { using Settings::Settings; };"
OPEN = "/{handle}/rate"
ROWS = [
    ("a member of one object", FRONT, "Front front(own);", "/demo/rate"),
    ("a variable", "", 'Settings settings(own); Settings::get<double>("rate", 5.0);', "/demo/rate"),
    ("another object", FRONT, 'Front front(own); ros::NodeHandle low("low"); Settings second(low);', OPEN),
    ("members of two objects", FRONT, 'Front front(own); ros::NodeHandle low("low"); Front second(low);', OPEN),
    ("a class that derives from it", FRONT + MINE, "Front front(own);", OPEN),
    ("made by a template", FRONT, "Front front(own); make<Settings>(own);", OPEN),
]


@pytest.mark.parametrize(("more", "made", "name"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_an_object_that_is_found_by_a_static_pointer_has_the_handle_of_the_only_one(
    workspace: Any, more: str, made: str, name: str
) -> None:
    """Where the tree makes several, or may make them unseen, which one it is stays open."""
    files = {
        "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n",
        "src/demo.cpp": SETTINGS.format(more=more, made=made),
    }
    found = workspace.package(files, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "parameter"} == {name}
