"""What `get_name()` and its like give: the name of a node of a node alone."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
class D : public rclcpp::Node {{
public:
  D() : Node("demo") {{
    {setup}
    auto a = create_publisher<std_msgs::msg::String>({name}, 1);
  }}
  {member}
}};
int main(int argc, char ** argv) {{ rclcpp::spin(std::make_shared<D>()); }}
"""
NODELET = """
#include <nodelet/nodelet.h>
class D : public nodelet::Nodelet {
  void onInit() override {
    auto a = getNodeHandle().advertise<std_msgs::String>(getName() + "/state", 1);
  }
};
PLUGINLIB_EXPORT_CLASS(D, nodelet::Nodelet)
"""
ROWS = [
    ("its own", "", 'std::string(get_name()) + "/state"', "", "/demo/state"),
    ("of itself", "", 'std::string(this->get_name()) + "/state"', "", "/demo/state"),
    (
        "of a pointer to it",
        "rclcpp::Node * node = this;",
        'std::string(node->get_name()) + "/state"',
        "",
        "/demo/state",
    ),
    ("in a format", "", 'std::format("{}/state", get_name())', "", "/demo/state"),
    ("in a format of a library", "", 'fmt::format("{}/{}", get_name(), "state")', "", "/demo/state"),
    ("of a parameter", "", 'given_.get_name() + "/state"', "rclcpp::Parameter given_;", "/{get_name}/state"),
    (
        "of a joint",
        "",
        'joint_.get_name() + "/state"',
        "hardware_interface::LoanedStateInterface joint_;",
        "/{get_name}/state",
    ),
]


@pytest.mark.parametrize(
    ("setup", "name", "member", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS]
)
def test_a_name_is_that_of_the_node_where_a_node_is_asked(
    workspace: Any, setup: str, name: str, member: str, expected: str
) -> None:
    """Parameters and joints have names of their own, which nobody shows."""
    text = NODE.format(setup=setup, name=name, member=member)
    assert workspace.package({"src/d.cpp": text}).only("publisher").name == expected


def test_hardware_has_a_name_that_its_description_gives(workspace: Any) -> None:
    """`get_name()` of a hardware component is what the robot description calls it, not a node's name."""
    text = """
    #include <hardware_interface/system_interface.hpp>
    class H : public hardware_interface::SystemInterface {
      hardware_interface::CallbackReturn on_init(const hardware_interface::HardwareInfo & info) override {
        auto a = get_node()->create_publisher<std_msgs::msg::String>(get_name() + "/state", 1);
      }
    };
    PLUGINLIB_EXPORT_CLASS(H, hardware_interface::SystemInterface)
    """
    assert "{get_name}" in workspace.package({"src/h.cpp": text}).only("publisher").name


def test_a_nodelet_is_called_as_it_is_loaded(workspace: Any) -> None:
    """`getName()` of a nodelet is its name in the graph."""
    found = workspace.package({"src/d.cpp": NODELET}, ros=1).only("publisher")
    assert "getName" not in found.name


def test_the_value_that_a_parameter_of_python_keeps(workspace: Any) -> None:
    """`_value` is read by many, and is the value."""
    text = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class D(Node):
    def __init__(self):
        super().__init__("d")
        self.declare_parameters("", [("topic", "asked")])
        self.sub = self.create_subscription(String, self.get_parameter("topic")._value, print, 1)


def main():
    rclpy.init()
    rclpy.spin(D())


if __name__ == "__main__":
    main()
"""
    assert workspace.package({"pkg/d.py": text}).only("subscriber").name == "/asked"


def test_a_node_below_a_node_of_its_own_name(workspace: Any) -> None:
    """`create_sub_node(get_name())` puts names where private ones are."""
    text = NODE.format(setup="auto sub = create_sub_node(get_name());", name='"x"', member="").replace(
        "auto a = create_publisher", "auto a = sub->create_publisher"
    )
    assert workspace.package({"src/d.cpp": text}).only("publisher").name == "/demo/x"


BESIDE = [
    (
        'auto t = declare_parameter<std::string>("t", "x");',
        'std::string(get_name()) + "/" + t',
        [("/demo/x", "default")],
    ),
    (
        'std::string t = "x"; if (f()) t = "y";',
        'std::string(get_name()) + "/" + t',
        [("/demo/x", "one_of"), ("/demo/y", "one_of")],
    ),
    (
        'auto t = declare_parameter<std::string>("t", "x");',
        'std::string(get_namespace()) + "/" + t',
        [("/x", "default")],
    ),
    ("", 'std::string(get_name()) + "/x"', [("/demo/x", "folded")]),
]


@pytest.mark.parametrize(("setup", "name", "expected"), BESIDE)
def test_a_name_is_as_sure_as_what_stands_beside_that_of_the_node(
    workspace: Any, setup: str, name: str, expected: list[tuple[str, str]]
) -> None:
    """The node's own name is known where it runs; what a parameter or a branch adds is not proved by that."""
    found = workspace.package({"src/d.cpp": NODE.format(setup=setup, name=name, member="")}).interfaces()
    assert sorted((each.name, each.confidence) for each in found if each.role == "publisher") == expected


SUB_NODES = [
    ("", "get_effective_namespace()", "/state"),
    ('auto s = create_sub_node("left");', "s->get_effective_namespace()", "/left/state"),
    ("auto s = create_sub_node(side());", "s->get_effective_namespace()", "/{side}/state"),
]


@pytest.mark.parametrize(("setup", "asked", "expected"), SUB_NODES)
def test_the_effective_namespace_has_that_of_the_sub_node(
    workspace: Any, setup: str, asked: str, expected: str
) -> None:
    """rclcpp/node.hpp: the namespace of the node, and below it that of the sub node; a name behind it is absolute."""
    text = NODE.format(setup=setup, name=f'std::string({asked}) + "/state"', member="")
    assert workspace.package({"src/d.cpp": text}).only("publisher").name == expected


WITH_USING = """
#include <ros/ros.h>
using namespace ros;
int main(int argc, char ** argv) {
  init(argc, argv, "demo");
  NodeHandle nh;
  double rate;
  nh.param(this_node::getName() + "/rate", rate, 5.0);
}
"""
OF_A_CLASS = """
#include <ros/ros.h>
class Planner {
public:
  std::string getName() { return "short"; }
  void setup(ros::NodeHandle & nh) { pub_ = nh.advertise<std_msgs::String>(ros::this_node::getName() + "/state", 1); }
  ros::Publisher pub_;
};
int main(int argc, char ** argv) {
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  Planner planner;
  planner.setup(nh);
}
"""
OWN_INIT = """
#include <ros/ros.h>
using namespace ros;
void init(int argc, char ** argv, const char * name);
void init(int argc, char ** argv, const char * name) { ros::init(argc, argv, "demo"); }
int main(int argc, char ** argv) {
  init(argc, argv, "other");
  NodeHandle nh("~");
  auto pub = nh.advertise<std_msgs::String>("state", 1);
}
"""


def test_the_name_of_the_node_is_known_by_what_using_brings(workspace: Any) -> None:
    """`using namespace ros` brings `init` and `this_node::getName` without their first name."""
    entry = workspace.package({"src/demo.cpp": WITH_USING}, ros=1).only("parameter")
    assert (entry.name, entry.default) == ("/demo/rate", 5.0)


def test_a_function_of_the_tree_is_nearer_than_what_using_brings(workspace: Any) -> None:
    """A function of the file that is called like one of roscpp is none that names the node by its arguments."""
    assert "/other" not in workspace.package({"src/demo.cpp": OWN_INIT}, ros=1).only("publisher").name


def test_a_function_of_a_library_is_no_method_of_the_same_name(workspace: Any) -> None:
    """`library::getName()` in a class that has a `getName` of its own is not that one."""
    assert workspace.package({"src/demo.cpp": OF_A_CLASS}, ros=1).only("publisher").name == "/demo/state"


OWN_NODE = """
#include <rclcpp/rclcpp.hpp>
{declared}
void open(rclcpp::Node & node) {{ auto a = node.create_publisher<std_msgs::msg::String>("~/state", 1); }}
int main(int argc, char ** argv) {{
  auto root = Node("root");
  auto node = rclcpp::Node::make_shared("demo");
  handed(open);
  rclcpp::spin(node);
}}
"""


@pytest.mark.parametrize(
    ("declared", "expected"),
    [
        ("struct Node { explicit Node(std::string name); };", "/demo/state"),
        ("struct Leaf { explicit Leaf(std::string name); }; using Node = Leaf;", "/demo/state"),
        ("using Node = rclcpp::Node;", "/{name}/state"),
        ("struct Node : rclcpp::Node { explicit Node(std::string name) : rclcpp::Node(name) {} };", "/{name}/state"),
    ],
    ids=["a struct", "an alias of one", "an alias of a node", "a class of nodes"],
)
def test_what_a_tree_calls_node_is_a_node_only_where_it_is_one(workspace: Any, declared: str, expected: str) -> None:
    """A name of whichever node is that of the only one there is: a struct of a tree of nodes was another."""
    found = workspace.package({"src/demo.cpp": OWN_NODE.format(declared=declared)}).interfaces()
    assert [row.name for row in found if row.role == "publisher"] == [expected]
