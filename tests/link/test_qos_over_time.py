"""A profile that a variable holds is that of the place: what is set before it, by whom, and never what comes after."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
class D : public rclcpp::Node {
public:
  D() : Node("d"), held_(10), twice_(1) {
    {body}
  }
  void set() { held_ = rclcpp::QoS(9).best_effort(); }
  void again() { held_ = rclcpp::QoS(2); }
  void other() { create_publisher<std_msgs::msg::String>("later", held_); }
  void one() { twice_ = rclcpp::QoS(1).best_effort(); }
  void two() { twice_ = rclcpp::QoS(1).reliable(); }
  void three() { create_publisher<std_msgs::msg::String>("open", twice_); }
private:
  rclcpp::QoS held_;
  rclcpp::QoS twice_;
};
int main(int argc, char ** argv) { auto n = std::make_shared<D>(); n->again(); n->other(); n->one(); rclcpp::spin(n); }
"""
PYTHON = """
from rclpy.node import Node
from rclpy.qos import *
from std_msgs.msg import String
class D(Node):
    def __init__(self):
        super().__init__('d')
        {body}
"""
ROWS = [
    ("auto q = rclcpp::QoS(4); q.best_effort(); {a} q.reliable(); {b}", ("best_effort", 4), ("reliable", 4)),
    ("auto q = rclcpp::QoS(4); q.keep_last(6).best_effort(); {a} {b}", ("best_effort", 6), ("best_effort", 6)),
    ("rclcpp::QoS q(4); {a} if (found()) { q.best_effort(); } {b}", ("reliable", 4), ("unknown", 4)),
    ("rclcpp::QoS q(4); {a} if (found()) { q = rclcpp::QoS(4).best_effort(); } {b}", ("reliable", 4), ("unknown", 4)),
    ("auto & q = held_; {a} held_ = rclcpp::QoS(3); {b}", ("reliable", 10), ("reliable", 3)),
    ("rclcpp::QoS q(1); {a} q.keep_last(5); {b} q.keep_last(7);", ("reliable", 1), ("reliable", 5)),
    (
        "rclcpp::QoS q(4); {a} for (int i = 0; i < n(); ++i) { q.best_effort(); } {b}",
        ("reliable", 4),
        ("unknown", None),
    ),
]
PYTHON_ROWS = [
    ("q = QoSProfile(depth=3)\n{a}\nq.reliability = ReliabilityPolicy.BEST_EFFORT\n{b}", "reliable", "best_effort"),
    (
        "q = QoSProfile(depth=3)\n{a}\nif self.x():\n    q.reliability = ReliabilityPolicy.BEST_EFFORT\n{b}",
        "reliable",
        "unknown",
    ),
]


def _publisher(name: str) -> str:
    return f'create_publisher<std_msgs::msg::String>("{name}", q);'


def _qos(found: Any) -> dict[str, tuple[str, int]]:
    made = (entry for entry in found.interfaces() if entry.role == "publisher")
    return {entry.name: (entry.qos.reliability, entry.qos.depth) for entry in made}


@pytest.mark.parametrize(("body", "first", "second"), ROWS, ids=[row[0][:40] for row in ROWS])
def test_a_profile_is_that_of_its_place(workspace: Any, body: str, first: Any, second: Any) -> None:
    """What is set behind an endpoint is not its own, and what one branch sets is unknown."""
    text = CPP.replace("{body}", body.replace("{a}", _publisher("a")).replace("{b}", _publisher("b")))
    found = _qos(workspace.package({"src/d.cpp": text}))
    assert (found["/a"], found["/b"]) == (first, second)


def test_a_profile_that_a_method_leaves(workspace: Any) -> None:
    """A member has what the last method before gave it; where nobody knows which ran last, it is unknown."""
    found = _qos(workspace.package({"src/d.cpp": CPP.replace("{body}", "set(); auto & q = held_; " + _publisher("a"))}))
    assert found["/a"] == ("best_effort", 9)
    assert found["/later"] == ("reliable", 2)
    assert found["/open"] == ("unknown", 1)


@pytest.mark.parametrize(("body", "first", "second"), PYTHON_ROWS, ids=["straight", "in a branch"])
def test_fields_of_a_profile_of_python(workspace: Any, body: str, first: str, second: str) -> None:
    """A field that is assigned counts from there on."""
    made = {key: f"self.create_publisher(String, '{key}', q)" for key in "ab"}
    lines = body.replace("{a}", made["a"]).replace("{b}", made["b"]).replace("\n", "\n        ")
    found = _qos(workspace.package({"pkg/d.py": PYTHON.replace("{body}", lines)}))
    assert (found["/a"][0], found["/b"][0]) == (first, second)


HANDED = """
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String
class Talker(Node):
    def __init__(self, name, profile):
        super().__init__(name)
        {body}
def main():
    read = QoSProfile(depth=3)
    first = Talker('a', read)
    first.create_publisher(String, 'b', read)
"""
HANDED_ROWS = [
    ("self.depth = profile.depth", "reliable"),
    ("self.out = self.create_publisher(String, 'a', profile)", "reliable"),
    ("profile.depth = 4", "unknown"),
    ("self.profile = profile", "unknown"),
    ("self.table = dict(a=profile)", "unknown"),
    ("self.later = lambda: profile", "unknown"),
    ("self.part = outside(profile)", "unknown"),
]


@pytest.mark.parametrize(("body", "after"), HANDED_ROWS, ids=[row[0][:40] for row in HANDED_ROWS])
def test_a_profile_that_a_constructor_of_python_gets(workspace: Any, body: str, after: str) -> None:
    """It stays what it is where the constructor only reads it; who keeps it may change it at any time."""
    found = _qos(workspace.package({"pkg/d.py": HANDED.replace("{body}", body)}))
    assert found["/b"][0] == after


CALLING_ITSELF = """
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String
class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.profile = QoSProfile(depth=3)
        while self.more():
            self.again()
            self.create_publisher(String, 'a', self.profile)
    def again(self):
        while self.more():
            self.profile = self.next_one(self.profile)
            self.again()
    def next_one(self, profile):
        while self.more():
            profile.depth += 1
        return profile
"""


def test_a_profile_that_a_method_gives_which_calls_itself(workspace: Any) -> None:
    """What it is depends on itself: that is unknown, and asked once."""
    assert _qos(workspace.package({"pkg/d.py": CALLING_ITSELF}))["/a"][0] == "unknown"
