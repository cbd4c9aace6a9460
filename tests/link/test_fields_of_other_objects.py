"""A field of one object is none of the others, though they are of one class."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

struct Topic {{ std::string name; }};
struct Box {{ Topic topic; }};

int main() {{
  auto node = std::make_shared<rclcpp::Node>("demo");
  std::vector<Topic> topics{{Topic{{"a"}}, Topic{{"b"}}}};
  topics[0].name = "c";
  Topic picked = pick();
  Box box{{picked}};
  use(box);
  {make}
}}
"""
MAKE = "node->create_publisher<std_msgs::msg::String>({name}, 10);"
ROWS = [
    ("another element", MAKE.format(name="topics[1].name")),
    ("another variable", f'Topic own; own.name = "c"; {MAKE.format(name="picked.name")}'),
    ("what is made for a pointer", f'auto own = std::make_shared<Topic>(); own->name = "c"; {MAKE.format(name="picked.name")}'),
    ("a part of another", f'auto own = std::make_shared<Topic>(); own->name = "c"; {MAKE.format(name="box.topic.name")}'),
    ("another name of a part", f'Topic own; own.name = "c"; Topic & part = box.topic; {MAKE.format(name="part.name")}'),
    ("a part of a copy", f'Box own = box; own.topic.name = "c"; {MAKE.format(name="box.topic.name")}'),
    ("any element", f"for (const auto & topic : topics) {{ {MAKE.format(name='topic.name')} }}"),
]  # fmt: skip


@pytest.mark.parametrize("make", [row[1] for row in ROWS], ids=[row[0] for row in ROWS])
def test_what_one_object_is_given_is_not_told_of_the_others_alone(workspace: Any, make: str) -> None:
    """What the others were made with is a hole here; what was given to one is no proof for them."""
    text = NODE.format(make=make)
    package = workspace.package({"src/d.cpp": text, "CMakeLists.txt": "add_executable(d src/d.cpp)"})
    found = [entry for entry in package.interfaces() if entry.role == "publisher"]
    assert any("{" in entry.name for entry in found)
    assert all(entry.confidence != "folded" for entry in found)


READ = """
#include <ros/ros.h>
struct Topic {{ std::string name; }};
struct Other {{ std::string name; }};
int main(int argc, char ** argv) {{
  ros::NodeHandle nh;
  Topic topic = pick();
  Topic next = pick();
  Other other;
  nh.param<std::string>("topic", topic.name, "a");
  nh.param<std::string>("other", other.name, "b");
  ros::Publisher pub = nh.advertise<std_msgs::String>({name}, 1);
}}
"""
READS = [("topic.name", [("/a", "default")]), ("other.name", [("/b", "default")])]


@pytest.mark.parametrize(("name", "expected"), READS, ids=[row[0] for row in READS])
def test_what_is_read_into_an_object_is_none_of_another_class(
    workspace: Any, name: str, expected: list[tuple[str, str]]
) -> None:
    """Fields of two classes may have one name."""
    text = READ.format(name=name)
    package = workspace.package({"src/d.cpp": text, "CMakeLists.txt": "add_executable(d src/d.cpp)"}, ros=1)
    assert [(each.name, each.confidence) for each in package.interfaces() if each.role == "publisher"] == expected


def test_what_is_read_into_an_object_is_not_told_of_another_alone(workspace: Any) -> None:
    """Of the other one nothing is known."""
    text = READ.format(name="next.name")
    package = workspace.package({"src/d.cpp": text, "CMakeLists.txt": "add_executable(d src/d.cpp)"}, ros=1)
    published = {(each.name, each.confidence) for each in package.interfaces() if each.role == "publisher"}
    assert published == {("/a", "one_of"), ("/{name}", "pattern")}


CHOSEN = """
import rclpy
from dataclasses import dataclass
from typing import NamedTuple
from rclpy.node import Node
from std_msgs.msg import String
class Pair(NamedTuple):
    kind: int
    topic: str = "pair"
@dataclass
class Row:
    kind: int
    topic: str = "row"
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.active = 0
        self.show((Pair(1, "a"), Pair(2, "b")), [Row(1, "c"), Row(2, "d")])
    def show(self, pairs, rows):
        self.listen(pairs[self.active], rows[self.active])
    def listen(self, pair: Pair, row: Row):
        self.create_publisher(String, pair.topic, 10)
        self.create_subscription(String, row.topic, self.called, 10)
    def called(self, msg):
        self.active += 1
def main():
    rclpy.spin(Demo())
"""


def test_a_field_of_one_object_of_many_has_no_default_of_its_class(workspace: Any) -> None:
    """What a class gives a field is nothing of an object that somebody makes with something else."""
    setup = (
        "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['demo = pkg.demo:main']})\n"
    )
    workspace.package({"pkg/__init__.py": "", "pkg/demo.py": CHOSEN, "setup.py": setup})
    told = {(entry.name, entry.confidence) for entry in workspace.interfaces()}
    assert told == {("/{topic}", "pattern")}
