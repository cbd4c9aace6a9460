"""Code of a tree that stands in the namespace of a library has the library's names without a prefix."""

from __future__ import annotations

from typing import Any

QUEUE = """
namespace actionlib {{
{own}
template <class Spec>
class QueuedServer {{
 public:
  QueuedServer(ros::NodeHandle n, std::string name) {{
    server_ = std::make_shared<ActionServer<Spec>>(n, name, false);
  }}
 private:
  std::shared_ptr<ActionServer<Spec>> server_;
}};
}}
"""
PROGRAM = """
#include <ros/ros.h>
{queue}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh("~");
  actionlib::QueuedServer<move_base_msgs::MoveBaseAction> server(nh, "move");
  ros::spin();
}}
"""
BUILD = "project(pkg)\nadd_executable(demo src/demo.cpp)\n"
OWN = """
template <class Spec>
class ActionServer {
 public:
  ActionServer(ros::NodeHandle n, std::string name, bool start) { pub_ = n.advertise<std_msgs::Bool>(name, 1); }
  ros::Publisher pub_;
};
"""


def test_a_class_in_the_namespace_of_actionlib_makes_its_servers(workspace: Any) -> None:
    """move_basic has a server with a queue in `namespace actionlib`: nothing was told of it, and no gap."""
    program = PROGRAM.format(queue=QUEUE.format(own=""))
    entry = workspace.package({"src/demo.cpp": program, "CMakeLists.txt": BUILD}, 1).only("action_server")
    assert (entry.name, entry.type) == ("/demo/move", "move_base_msgs/action/MoveBase")


def test_a_class_that_the_tree_has_in_that_namespace_is_the_one_that_is_meant(workspace: Any) -> None:
    """What its own constructor makes is told, and no action."""
    program = PROGRAM.format(queue=QUEUE.format(own=OWN))
    found = workspace.package({"src/demo.cpp": program, "CMakeLists.txt": BUILD}, 1).interfaces()
    assert [(each.role, each.name) for each in found] == [("publisher", "/demo/move")]


def test_a_namespace_of_the_same_name_elsewhere_is_not_that_of_the_library(workspace: Any) -> None:
    """`mine::actionlib` has other names."""
    program = PROGRAM.format(queue=QUEUE.format(own="")).replace("namespace actionlib {", "namespace mine::actionlib {")
    program = program.replace("  actionlib::Queued", "  mine::actionlib::Queued")
    found = workspace.package({"src/demo.cpp": program, "CMakeLists.txt": BUILD}, 1).interfaces()
    assert [each.role for each in found] == []


ASKING = """
#include <ros/ros.h>
namespace ros {{
{own}
class Extra {{
 public:
  Extra() {{ param::get("rate", rate_); }}
  int rate_;
}};
}}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::Extra extra;
  ros::spin();
}}
"""


def test_a_function_of_roscpp_is_called_without_ros_within_its_namespace(workspace: Any) -> None:
    """`param::get` is `ros::param::get` there."""
    program = {"src/demo.cpp": ASKING.format(own=""), "CMakeLists.txt": BUILD}
    entry = workspace.package(program, 1).only("parameter")
    assert (entry.name, entry.type) == ("/rate", "integer")


def test_a_function_that_the_tree_has_in_that_namespace_is_the_one_that_is_called(workspace: Any) -> None:
    """It asks for nothing."""
    own = "namespace param { bool get(const std::string & key, int & value) { return false; } }"
    program = {"src/demo.cpp": ASKING.format(own=own), "CMakeLists.txt": BUILD}
    assert workspace.package(program, 1).interfaces() == []
