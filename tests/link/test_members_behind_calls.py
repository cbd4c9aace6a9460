"""Members behind calls of methods, lambdas and functions that change them, or parts of them, in whatever way."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Params {{ std::string topic = "begun"; void load() {{ topic = "set"; }} }};
static void fill(Params & p) {{ p.topic = "set"; }}
static void run(const std::function<void()> & f) {{ f(); }}
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("demo") {{ p_.topic = "own"; q_.topic = "own"; name_ = "own"; {begin} {ask} }}
  void pub(const std::string & name) {{ create_publisher<std_msgs::msg::String>(name, 1); }}
  Params & shown() {{ return p_; }}
  void again() {{ name_ = "set"; }}
  Params made() {{ Params p; p.topic = "set"; return p; }}
  void change() {{ {change} }}
  Params p_, q_; std::shared_ptr<Params> shared_ = std::make_shared<Params>();
  Params * pointer_ = &p_; Params & reference_ = p_; std::once_flag flag_;
  std::vector<Params> all_; std::string name_; std::string read_ = "begun";
}};
int main() {{ auto node = std::make_shared<Demo>(); }}
"""
OPEN = "{}"
P, FIRST, READ = "pub(p_.topic);", "for (auto & each : all_) pub(each.topic);", "pub(read_);"
ROWS = [
    ("two names of one spelling", '{ auto & p = p_; p.topic = "set"; } { auto & p = q_; p.topic = "other"; }', P, OPEN),
    ("a name of it", 'auto & p = p_; p.topic = "set";', P, "set"),
    ("a copy of it", 'auto p = p_; p.topic = "set";', P, "own"),
    ("a pointer to it", 'for (auto * p : {&p_, &q_}) p->topic = "set";', P, OPEN),
    ("a shared pointer", 'auto p = shared_; p->topic = "set";', "pub(shared_->topic);", OPEN),
    ("the elements of a list", 'for (auto & c : all_) c.topic = "set";', FIRST, OPEN),
    ("a place of a list", 'all_[0].topic = "set";', FIRST, OPEN),
    ("the whole anew", 'p_ = Params{"set"};', P, "set"),
    ("the whole as a method makes it", "p_ = made();", P, "set"),
    ("a function that gets it", "fill(p_);", P, "set"),
    ("a function of elsewhere that gets it", "other::fill(p_);", P, OPEN),
    ("a method of it", "p_.load();", P, OPEN),
    ("what a method shows", 'shown().topic = "set";', P, "set"),
    ("a member that points to it", 'pointer_->topic = "set";', P, OPEN),
    ("a member that refers to it", 'reference_.topic = "set";', P, OPEN),
    ("one of two", 'auto & r = other::yes() ? p_ : q_; r.topic = "set";', P, OPEN),
    ("a method that is called once", "std::call_once(flag_, &Demo::again, this);", "pub(name_);", "set"),
    ("a lambda that is called", 'auto f = [this]() { name_ = "set"; }; f();', "pub(name_);", OPEN),
    ("a lambda that is handed on", 'run([this]() { name_ = "set"; });', "pub(name_);", OPEN),
]
IN_ONE = [
    ("a lambda that reads it", 'auto f = [this]() { read_ = declare_parameter("t", "set"); }; f();', READ, OPEN),
    ("a lambda that calls a method", "auto f = [this]() { change(); }; f();", "pub(name_);", "set"),
    ("a lambda that also does", 'auto f = [this]() { read_ = "x"; change(); }; f();', "pub(name_);", "set"),
]


def _publishers(workspace: Any, change: str, begin: str, ask: str) -> set[tuple[str, str]]:
    text = CPP.format(change=change, begin=begin, ask=ask)
    found = workspace.package({"src/demo.cpp": text}).interfaces()
    return {(each.name, each.confidence) for each in found if each.role == "publisher"}


def _are_as(found: set[tuple[str, str]], told: str) -> bool:
    """Whether a name is told; where nobody can know it, that none is proved."""
    if told == OPEN:
        return bool(found) and not any(confidence in {"literal", "folded", "default"} for _, confidence in found)
    return f"/{told}" in {name for name, _ in found}


@pytest.mark.parametrize(("change", "ask", "told"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_what_a_method_changes_is_not_told_as_it_was(workspace: Any, change: str, ask: str, told: str) -> None:
    """Who calls a method finds what that left, and nothing proved where the way is not followed."""
    begin = "all_.push_back(p_); change();"
    assert _are_as(_publishers(workspace, change, begin, ask), told)


@pytest.mark.parametrize(("begin", "ask", "told"), [row[1:] for row in IN_ONE], ids=[row[0] for row in IN_ONE])
def test_what_a_lambda_changes_is_not_told_as_it_was(workspace: Any, begin: str, ask: str, told: str) -> None:
    """A lambda that is called changes members there and then."""
    assert _are_as(_publishers(workspace, 'name_ = "set";', begin, ask), told)


PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Params:
    def __init__(self, topic):
        self.topic = topic
    def load(self):
        self.topic = 'set'
def fill(params):
    params.topic = 'set'
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.p = Params('own')
        self.q = Params('own')
        self.p.topic = 'own'
        self.all = [Params('own')]
        self.name = 'own'
        self.change()
        {ask}
    def pub(self, name):
        self.create_publisher(String, name, 1)
    def put(self, name):
        self.name = name
    def change(self):
        {change}
"""
EACH = "[self.pub(each.topic) for each in self.all]"
OF_PYTHON = [
    ("a name of it", "p = self.p; p.topic = 'set'", "self.pub(self.p.topic)", "set"),
    ("elements", "for each in self.all: each.topic = 'set'", EACH, OPEN),
    ("numbered elements", "for at, each in enumerate(self.all): each.topic = f'set{at}'", EACH, OPEN),
    ("both of two", "for each in (self.p, self.q): each.topic = 'set'", "self.pub(self.p.topic)", "set"),
    ("the whole anew", "self.p = Params('set')", "self.pub(self.p.topic)", "set"),
    ("a function that gets it", "fill(self.p)", "self.pub(self.p.topic)", "set"),
    ("a method of it", "self.p.load()", "self.pub(self.p.topic)", OPEN),
    ("a text by another name", "name = self.name; name += 'x'", "self.pub(self.name)", "own"),
    ("any field", "for key in ('name',): setattr(self, key, 'set')", "self.pub(self.name)", OPEN),
    ("a method that map calls", "list(map(self.put, ['set']))", "self.pub(self.name)", OPEN),
    ("a function within", "def inner(): self.name = 'set'\n        inner()", "self.pub(self.name)", OPEN),
]


@pytest.mark.parametrize(("change", "ask", "told"), [row[1:] for row in OF_PYTHON], ids=[row[0] for row in OF_PYTHON])
def test_what_a_method_of_python_changes(workspace: Any, change: str, ask: str, told: str) -> None:
    """Names of one object are all of it; texts never change."""
    text = PYTHON.format(change=change, ask=ask)
    found = workspace.package({"pkg/demo.py": text}).interfaces()
    told_now = {(each.name, each.confidence) for each in found if each.role == "publisher"}
    assert _are_as(told_now, told)


IN_CALLBACKS = """
import rclpy
from dataclasses import dataclass
from rclpy.node import Node
from std_msgs.msg import String
@dataclass
class Params:
    topic: str = 'begun'
def fill(params):
    params.topic = 'set'
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.p = Params()
        {begin}
        self.create_timer(1.0, self.tick)
    def change(self):
        self.p.topic = 'set'
    def load(self):
        self.p.topic = self.declare_parameter('topic', 'set').value
    def tick(self):
        self.create_publisher(String, self.p.topic, 1)
"""


@pytest.mark.parametrize(
    "begin", ["self.change()", "self.load()", "fill(self.p)", "self.p.topic = 'set'", "p = self.p; p.topic = 'set'"]
)
def test_what_a_callback_finds_in_a_field_of_python(workspace: Any, begin: str) -> None:
    """A field of a member is what the methods leave it with, not what its object was made with."""
    assert workspace.package({"pkg/demo.py": IN_CALLBACKS.format(begin=begin)}).only("publisher").name == "/set"


CALLED = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Params {{ std::string topic = "begun"; }};
static void fill(Params & p) {{ p.topic = "set"; }}
static void load(rclcpp::Node & n, Params & p) {{ p.topic = n.declare_parameter<std::string>("topic", "set"); }}
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("demo") {{ p_.topic = "own"; {begin} t_ = create_wall_timer(1s, [this]() {{ tick(); }}); }}
  void tick() {{ create_publisher<std_msgs::msg::String>(p_.topic, 1); }}
  Params p_;
}};
int main() {{ auto node = std::make_shared<Demo>(); }}
"""


@pytest.mark.parametrize("begin", ["fill(p_);", "load(*this, p_);", 'p_ = Params{"set"};'])
def test_what_a_callback_finds_in_a_field(workspace: Any, begin: str) -> None:
    """So in C++, where a function gets the member by reference."""
    assert workspace.package({"src/demo.cpp": CALLED.format(begin=begin)}).only("publisher").name == "/set"


def test_a_field_that_one_callback_changes_is_one_of_several(workspace: Any) -> None:
    """Nobody knows which callback runs first."""
    begin = "self.create_timer(2.0, self.change)"
    found = workspace.package({"pkg/demo.py": IN_CALLBACKS.format(begin=begin)}).interfaces()
    assert {(each.name, each.confidence) for each in found if each.role == "publisher"} != {("/begun", "folded")}


HANDED = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
def fill(node):
    node.topic = 'set'
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.topic = 'own'
        {begin}
        self.create_publisher(String, self.topic, 1)
    def change(self):
        fill(self)
"""


@pytest.mark.parametrize("begin", ["fill(self)", "self.change()"])
def test_a_function_that_gets_the_object_at_hand_changes_it(workspace: Any, begin: str) -> None:
    """Who is handed `self` may give it what he likes, though he need not say what he gets."""
    found = workspace.package({"pkg/demo.py": HANDED.format(begin=begin)}).interfaces()
    assert _are_as({(each.name, each.confidence) for each in found if each.role == "publisher"}, OPEN)


def test_a_field_that_no_constructor_gives_anything_may_be_as_it_was_made(workspace: Any) -> None:
    """What one method makes of it is not all: another one may find it as its object was made."""
    text = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Params { std::string topic; std::string space = "begun"; };
class Demo : public rclcpp::Node {
public:
  Demo() : Node("demo") {}
  Params remade() { Params p{"x"}; p.space = "set"; return p; }
  void change() { p_ = remade(); }
  void start() { p_.topic = "own"; create_publisher<std_msgs::msg::String>(p_.space, 1); }
  Params p_{"made"};
};
int main() { auto node = std::make_shared<Demo>(); node->start(); rclcpp::spin(node); }
"""
    found = workspace.package({"src/demo.cpp": text}).interfaces()
    assert _are_as({(each.name, each.confidence) for each in found if each.role == "publisher"}, OPEN)


def test_a_member_that_a_method_makes_anew_may_be_as_it_was_declared(workspace: Any) -> None:
    """A method of an object that another method replaces finds the one of its declaration, too."""
    text = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Params { std::string topic; std::string space = "begun"; std::string full() const { return space; } };
class Demo : public rclcpp::Node {
public:
  Demo() : Node("demo") {}
  Params remade() { Params p{"x"}; p.space = "set"; return p; }
  void change() { p_ = remade(); }
  void start() { create_publisher<std_msgs::msg::String>(p_.full(), 1); }
  Params p_{"made"};
};
int main() { auto node = std::make_shared<Demo>(); node->start(); rclcpp::spin(node); }
"""
    found = workspace.package({"src/demo.cpp": text}).interfaces()
    told = {(each.name, each.confidence) for each in found if each.role == "publisher"}
    assert ("/{space}", "pattern") in told
