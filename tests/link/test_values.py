"""Names that are computed: what folds, what stays a pattern."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include "names.hpp"
#define FROM_MACRO "from_macro"
namespace demo {{
constexpr auto CONSTANT = "constant";
static const std::string PREFIX = "robot/";
std::string joined(const std::string & ns, const std::string & leaf) {{ return ns + "/" + leaf; }}
void fill(const std::string & key, std::string & out) {{ out = "filled/" + key; }}
bool read_or(const std::string & key, std::string & out, const std::string & fallback) {{
  if (!has(key)) {{ out = fallback; return false; }} else {{ out = get(key); return true; }}
}}
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo"), member_("from_initialiser") {{ set_in_body_ = "from_body"; }}
  void start(const std::string & given) {{
    {setup}
    create_publisher<std_msgs::msg::String>({name}, 10);
  }}
  static constexpr char STATIC[] = "static";
  std::string member_, set_in_body_;
  std::string with_default_{{"from_default"}};
}};
}}
"""
ROWS = [
    ("", "CONSTANT", "/constant", "folded"),
    ("", 'PREFIX + "odom"', "/robot/odom", "folded"),
    ("", "STATIC", "/static", "folded"),
    ("", "Demo::STATIC", "/static", "folded"),
    ("", "FROM_MACRO", "/from_macro", "folded"),
    ("", "names::IN_HEADER", "/in_header", "folded"),
    ("", "member_", "/from_initialiser", "folded"),
    ("", "set_in_body_", "/from_body", "folded"),
    ("", "with_default_", "/from_default", "folded"),
    ("", 'std::string("a") + "/b"', "/a/b", "folded"),
    ("", 'joined("ns", "leaf")', "/ns/leaf", "folded"),
    ("", 'resolve_topic_name("image")', "/image", "literal"),
    ("", 'fmt::format("{}/{}", "a", CONSTANT)', "/a/constant", "folded"),
    ('auto n = declare_parameter<std::string>("topic", "odom");', "n", "/odom", "default"),
    (
        'declare_parameter("topic", "odom"); auto n = get_parameter("topic").as_string();',
        "n",
        "/odom",
        "default",
    ),
    (
        'declare_parameter("topic", "odom"); std::string n; get_parameter("topic", n);',
        "n",
        "/odom",
        "default",
    ),
    (
        'auto s = create_subscription<std_msgs::msg::String>("in", 1, [](std_msgs::msg::String m) {});',
        'std::string(s->get_topic_name()) + "/out"',
        "/in/out",
        "folded",
    ),
    (
        (
            'rclcpp::Subscription<M>::SharedPtr s; if (x) { s = create_subscription<M>("first", 1, f); }'
            ' else { s = create_subscription<M>("second", 1, f); }'
        ),
        "s->get_topic_name()",
        None,
        "one_of",
    ),
    (
        'auto s = create_subscription<M>("in", 1, f); if (x) { s = outside(); }',
        "s->get_topic_name()",
        "/{get_topic_name}",
        "pattern",
    ),
    ("", 'std::string("a").append("/b").c_str()', "/a/b", "folded"),
    ("", 'std::string(get_name()).append("/state")', "/demo/state", "folded"),
    ('std::string n = "a"; n += "/b";', "n", "/a/b", "folded"),
    ('std::string n; if (x) { n = "first"; } else { n = "second"; }', "n", None, "one_of"),
    ("", 'std::string(get_namespace()) + "/state"', "/state", "folded"),
    ('std::string ns = get_namespace(); auto up = ns.substr(0, ns.rfind("/"));', 'up + "/state"', "/state", "folded"),
    ('std::string ns = "/a/b"; auto up = ns.substr(0, ns.rfind("/"));', 'up + "/state"', "/a/state", "folded"),
    ('char n[19] = "arm00"; snprintf(n, sizeof(n), "arm%02d/%s", 7, "odom");', "n", "/arm07/odom", "folded"),
    ('char n[9]; snprintf(n, sizeof(n), "arm%02d/%s", 7, "odom");', "n", "/arm07/od", "folded"),
    ('constexpr int MOST = 8; char n[MOST]; snprintf(n, sizeof n - 1, "arm/%s", "odom");', "n", "/arm/od", "folded"),
    ('snprintf(n_, sizeof(n_), "arm%02d/%s", 7, "odom");', "n_", "/arm07/odom", "default"),
    ('char n[9]; snprintf(n, sizeof(n), "arm%02d/%s", 7, given);', "n", "/arm07/{given}", "pattern"),
    ('char n[9]; for (int i = 0; i < 4; i++) { sprintf(n, "arm%d", i); }', "n", "/arm3", "folded"),
    ('std::string n; fill("topic", n);', "n", "/filled/topic", "folded"),
    ("", 'given + "/state"', "/{given}/state", "pattern"),
    ("", 'compute() + "/state"', "/{compute}/state", "pattern"),
]


@pytest.mark.parametrize(
    ("setup", "name", "expected", "confidence"), ROWS, ids=[f"{row[0][:30]} {row[1]}" for row in ROWS]
)
def test_cpp_name_folds(workspace: Any, setup: str, name: str, expected: str | None, confidence: str) -> None:
    """A computed name is folded as far as the tree shows it, and says how surely it is known."""
    files = {
        "src/demo.cpp": CPP.format(setup=setup, name=name),
        "include/pkg/names.hpp": 'namespace names { const char IN_HEADER[] = "in_header"; }',
    }
    found = [entry for entry in workspace.package(files).interfaces() if entry.role == "publisher"]
    assert {entry.confidence for entry in found} == {confidence}
    assert {entry.name for entry in found} == ({expected} if expected else {"/first", "/second"})


PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from pkg.names import SHARED
TOPIC = 'global'

class Demo(Node):
    LEVEL = 'class_level'
    def __init__(self, suffix='left'):
        super().__init__('demo')
        self.prefix = 'robot'
        {setup}
        self.create_publisher(String, {name}, 10)
"""
PYTHON_ROWS = [
    ("", "TOPIC", "/global", "folded"),
    ("", "SHARED", "/shared", "folded"),
    ("", "self.LEVEL", "/class_level", "folded"),
    ("", "f'{self.prefix}/odom'", "/robot/odom", "folded"),
    ("", "'%s/odom' % self.prefix", "/robot/odom", "folded"),
    ("", "'{}/odom'.format(self.prefix)", "/robot/odom", "folded"),
    ("", "'/'.join([self.prefix, 'odom'])", "/robot/odom", "folded"),
    ("", "self.prefix + '/' + suffix", "/robot/left", "default"),
    ("n = self.declare_parameter('topic', 'odom').value", "n", "/odom", "default"),
    (
        "n = self.declare_parameter('topic', 'odom').get_parameter_value().string_value",
        "n",
        "/odom",
        "default",
    ),
    (
        "self.declare_parameter('topic', 'odom'); n = self.get_parameter('topic').value",
        "n",
        "/odom",
        "default",
    ),
    ("import sys; n = sys.argv[1]", "n", "/{item}", "pattern"),
]


@pytest.mark.parametrize(("setup", "name", "expected", "confidence"), PYTHON_ROWS, ids=[row[1] for row in PYTHON_ROWS])
def test_python_name_folds(workspace: Any, setup: str, name: str, expected: str, confidence: str) -> None:
    """The same folding holds in Python, across imports of the package."""
    files = {
        "pkg/demo.py": PYTHON.replace("{setup}", setup).replace("{name}", name),
        "pkg/names.py": "SHARED = 'shared'\n",
        "pkg/__init__.py": "",
    }
    entry = workspace.package(files).only("publisher")
    assert (entry.name, entry.confidence) == (expected, confidence)


def test_a_helper_that_may_write_either_value_gives_both(workspace: Any) -> None:
    """What a function writes by reference on two ways is one of two values."""
    body = 'std::string n; read_or("topic", n, "fallback");'
    workspace.package({"src/demo.cpp": CPP.format(setup=body, name="n")})
    found = {(entry.name, entry.confidence) for entry in workspace.interfaces() if entry.role == "publisher"}
    assert found == {("/fallback", "one_of"), ("/{get}", "pattern")}


def test_values_that_define_each_other_end(workspace: Any) -> None:
    """Members that are set from each other give a pattern, not an endless search."""
    text = """
class D : public rclcpp::Node {
public:
  D() : Node("d") {}
  void turn() { a_ = b_ + "x"; }
  void back() { b_ = a_ + "y"; }
  void late() { create_client<std_srvs::srv::Empty>(a_); }
  std::string a_, b_;
};"""
    assert workspace.package({"src/d.cpp": text}).only("service_client").confidence == "pattern"


def test_lists_that_define_each_other_end(workspace: Any) -> None:
    """Each way round members that are set from each other is walked once: without that this takes minutes."""
    names = "abcdefgh"
    methods = "".join(
        f"    def {n}(self):\n        " + "; ".join(f"self.{m} = self.{n}" for m in names) + "\n" for n in "ab"
    )
    body = "\n".join(f"    def m{n}(self, {n}):\n        self.{n} = {n}\n        self.{n} = self.{n}" for n in names)
    made = (
        "    def start(self, a):\n        self.a = self.a\n        rospy.Publisher(self.a[0], String, queue_size=1)\n"
    )
    text = f"import rospy\nfrom std_msgs.msg import String\nclass D(object):\n{made}{methods}{body}\nD().start('x')\n"
    assert workspace.package({"scripts/d.py": text}, ros=1).only("publisher").confidence == "pattern"


def test_options_of_a_script_have_their_defaults(workspace: Any) -> None:
    """A name given on the command line is known by the default of its option."""
    script = """#!/usr/bin/env python
import argparse
import rospy
from std_msgs.msg import String
parser = argparse.ArgumentParser()
parser.add_argument('-n', '--robot-ns', default='/robot')
args = parser.parse_args()
pub = rospy.Publisher(args.robot_ns + '/state', String, queue_size=1)
"""
    entry = workspace.package({"scripts/s.py": script}, ros=1).only("publisher")
    assert (entry.name, entry.confidence) == ("/robot/state", "default")


def test_parameters_read_into_an_unnamed_struct_are_typed(workspace: Any) -> None:
    """The member that receives a parameter tells its type, also in a struct without a name."""
    text = """
class D { struct { int packets; std::string model; } config_;
  void read() { ros::NodeHandle nh("~"); nh.getParam("packets", config_.packets); nh.getParam("model", config_.model); } };"""
    found = {(entry.raw_name, entry.type) for entry in workspace.package({"src/d.cpp": text}, ros=1).interfaces()}
    assert found == {("~packets", "integer"), ("~model", "string")}


PLUGINS = """
from std_msgs.msg import String
from rclpy.node import Node
class Base(Node):
    space = "base"
    topic = "points"
    def start(self):
        self.create_subscription(String, self.space + "/" + self.topic, print, 1)
class Fence(Base):
    space = "fence"
    topic = "fences"
def main():
    fence = Fence("a")
    fence.start()
    rclpy.spin(fence)
"""


def test_an_attribute_of_a_derived_class_hides_that_of_its_base(workspace: Any) -> None:
    """The two are never mixed."""
    entries = workspace.package({"pkg/fence.py": PLUGINS}).interfaces()
    found = {entry.name for entry in entries if entry.role == "subscriber"}
    assert "/fence/fences" in found
    assert not found & {"/fence/points", "/base/fences"}


def test_lists_that_are_set_from_each_other_end(workspace: Any) -> None:
    """Members handed to and fro in many functions are looked at once each."""
    pairs = "\n".join(
        f"    def f{n}(self):\n        self.a = self.b\n        self.b = self.c\n        self.c = self.a"
        for n in range(8)
    )
    text = f"""
import rospy
from std_msgs.msg import String
class D:
{pairs}
    def start(self):
        self.c = ["last"]
        rospy.Publisher(self.a[0], String, queue_size=1)
rospy.init_node("d")
D().start()
"""
    entry = workspace.package({"scripts/d.py": text}, ros=1).only("publisher")
    assert entry.confidence in {"folded", "pattern"}


SAME_PARAMETER = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Robot(Node):
    def __init__(self):
        super().__init__('{node}')
        self.declare_parameter('robot', '{robot}')
        self.create_publisher(String, self.get_parameter('robot').value + '/state', 10)
"""


def test_nodes_of_a_package_give_one_parameter_their_own_defaults(workspace: Any) -> None:
    """Classes of one name in several scripts declare what they read; the first one of the package says nothing."""
    nodes = {"a": "left", "b": "right", "c": "middle"}
    files = {f"pkg/{node}.py": SAME_PARAMETER.format(node=node, robot=robot) for node, robot in nodes.items()}
    modules = workspace.package(files).modules()
    told = {
        node: [each.name for each in modules[f"ecm.pkg.{node}"].signature.interfaces if each.role == "publisher"]
        for node in nodes
    }
    assert told == {"a": ["/left/state"], "b": ["/right/state"], "c": ["/middle/state"]}


def test_a_parameter_with_several_defaults_has_none_for_others(workspace: Any) -> None:
    """Who reads a parameter that two other nodes of the package declare differently gets a pattern."""
    files = {f"pkg/{node}.py": SAME_PARAMETER.format(node=node, robot=node) for node in ("left", "right")}
    reader = SAME_PARAMETER.format(node="reader", robot="none").replace("self.declare_parameter('robot', 'none')", "")
    modules = workspace.package({**files, "pkg/reader.py": reader}).modules()
    (end,) = [each for each in modules["ecm.pkg.reader"].signature.interfaces if each.role == "publisher"]
    assert (end.name, end.confidence) == ("/{robot}/state", "pattern")


@pytest.mark.parametrize(
    "declaration",
    [
        "self.declare_parameter('robot', Parameter.Type.STRING)",
        "self.declare_parameter('robot')",
        "self.declare_parameters('', [('robot', Parameter.Type.STRING)])",
    ],
)
def test_what_a_node_declares_without_a_default_has_not_that_of_another_node(workspace: Any, declaration: str) -> None:
    """A parameter that is declared by its type is what somebody sets; the default of another node of the package is not its."""
    bare = SAME_PARAMETER.format(node="bare", robot="none").replace(
        "self.declare_parameter('robot', 'none')", declaration
    )
    files = {"pkg/full.py": SAME_PARAMETER.format(node="full", robot="left"), "pkg/bare.py": bare}
    reader = SAME_PARAMETER.format(node="reader", robot="none").replace("self.declare_parameter('robot', 'none')", "")
    modules = workspace.package({**files, "pkg/reader.py": reader}).modules()
    ends = {
        node: [each.name for each in modules[f"ecm.pkg.{node}"].signature.interfaces if each.role == "publisher"]
        for node in ("full", "bare", "reader")
    }
    assert ends == {"full": ["/left/state"], "bare": ["/{robot}/state"], "reader": ["/{robot}/state"]}
