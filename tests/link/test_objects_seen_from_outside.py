"""Which methods a call by a pointer runs is told by whoever hands it the objects, where these are seen to be made."""

from __future__ import annotations

from typing import Any

import pytest

CODE = """
#include <ros/ros.h>
struct Stage {{ virtual void load(ros::NodeHandle & nh) = 0; }};
struct Camera : Stage {{ void load(ros::NodeHandle & nh) override {{ nh.getParam("camera", a_); }} int a_; }};
struct Lidar : Stage {{ void load(ros::NodeHandle & nh) override {{ nh.getParam("lidar", a_); }} int a_; }};
struct Sonar : Stage {{ void load(ros::NodeHandle & nh) override {{ nh.getParam("sonar", a_); }} int a_; }};
void all(const std::vector<std::shared_ptr<Stage>> & stages, ros::NodeHandle & nh) {{
  for (const auto & stage : stages) stage->load(nh);
}}
void one(std::shared_ptr<Stage> stage, ros::NodeHandle & nh) {{ stage->load(nh); }}
struct Owner {{
  void begin(ros::NodeHandle & nh) {{ {begin} }}
  void change() {{ first_ = std::make_shared<Camera>(); first_.reset(new Lidar()); }}
  std::shared_ptr<Stage> first_;
  std::shared_ptr<Stage> second_;
}};
struct Other {{
  void begin(ros::NodeHandle & nh) {{ mine_ = std::make_shared<Sonar>(); all({{mine_}}, nh); one(mine_, nh); }}
  std::shared_ptr<Stage> mine_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh("a"), others("b");
  Owner owner;
  Other other;
  {main}
  owner.begin(nh);
  other.begin(others);
}}
"""
FIRST = "first_ = std::make_shared<Camera>(); "
SECOND = "second_ = std::make_shared<Lidar>(); "
MADE = "Camera a; Lidar b;"
ALL = {"camera", "lidar", "sonar"}
ROWS = [
    ("two of a list", FIRST + SECOND + "all({first_, second_}, nh);", "", {"camera", "lidar"}),
    ("one that is handed", FIRST + "one(first_, nh);", "", {"camera"}),
    (
        "one of two makers",
        "if (fast()) " + FIRST + "else first_ = std::make_shared<Lidar>(); one(first_, nh);",
        "",
        {"camera", "lidar"},
    ),
    ("one that is put in its place", "one(first_, nh);", "Lidar a; owner.change();", ALL),
    ("one of a local", "auto mine = std::make_shared<Lidar>(); one(mine, nh);", "", {"lidar"}),
    ("one that others may give", "one(first_, nh);", "owner.first_ = other(); " + MADE, ALL),
    ("one that is given here after others", FIRST + "one(first_, nh);", "owner.first_ = other();", {"camera"}),
    ("one of which nobody tells", "first_ = other(); one(first_, nh);", MADE, ALL),
    ("a list with one of them", FIRST + "second_ = other(); all({first_, second_}, nh);", MADE, ALL),
]


DERIVED = """
#include <ros/ros.h>
struct Stage { virtual void load(ros::NodeHandle & nh) = 0; };
struct Camera : Stage { void load(ros::NodeHandle & nh) override { nh.getParam("camera", a_); } int a_; };
struct Lidar : Stage { void load(ros::NodeHandle & nh) override { nh.getParam("lidar", a_); } int a_; };
void one(std::shared_ptr<Stage> stage, ros::NodeHandle & nh) { stage->load(nh); }
struct Owner {
  Owner() { stage_ = std::make_shared<Camera>(); }
  void begin(ros::NodeHandle & nh) { one(stage_, nh); }
  std::shared_ptr<Stage> stage_;
};
struct Other : Owner {
  Other() { stage_ = std::make_shared<Lidar>(); }
};
void go(Owner & owner, ros::NodeHandle & nh) { owner.begin(nh); }
int main(int argc, char ** argv) {
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  Other other;
  CALL
}
"""


@pytest.mark.parametrize("call", ["other.begin(nh);", "go(other, nh);", "go(given(), nh);"])
def test_a_derived_class_may_give_a_member_another_object(workspace: Any, call: str) -> None:
    """What the base gives its member is not all that a method of the base finds there."""
    found = workspace.package({"src/demo.cpp": DERIVED.replace("CALL", call)}, ros=1).interfaces()
    assert "lidar" in {row.name.strip("/") for row in found if row.role == "parameter"}


@pytest.mark.parametrize(("begin", "main", "names"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_methods_of_objects_that_are_seen_to_be_others_are_not_told(
    workspace: Any, begin: str, main: str, names: set[str]
) -> None:
    """Each class that derives from the one of the pointer was told, of whichever caller."""
    found = workspace.package({"src/demo.cpp": CODE.format(begin=begin, main=main)}, ros=1).interfaces()
    told = {row.name.strip("/") for row in found if row.role == "parameter"}
    assert told == {f"a/{name}" for name in names} | {"b/sonar"}
