"""What a node waits for, and the state in which it works, are its preconditions."""

from __future__ import annotations

import pytest
from section_contracts import INCLUDE, contract, value
from workspaces import Workspace

WAITS = """
class N : public rclcpp::Node {
public:
  N() : Node("n") {
    early_ = create_client<std_srvs::srv::Trigger>("early");
    late_ = create_client<std_srvs::srv::Trigger>("late");
    prepare();
    s_ = create_service<std_srvs::srv::Trigger>("go", std::bind(&N::go, this, _1, _2));
  }
  void prepare() { wait(); }
  void wait() { rclcpp::wait_for_message(m, node, "ready"); }
  void go(A a, B b) { rclcpp::wait_for_message(m, node, "later"); helper(); }
  void helper() { rclcpp::wait_for_message(m, node, "much_later"); }
};
"""
PYTHON_WAITS = """
import rospy
def on_scan(message):
    rospy.wait_for_service("late")
def prepare():
    rospy.wait_for_service("early")
def main():
    rospy.initnode("n")
    prepare()
    rospy.Subscriber("scan", LaserScan, on_scan)
    rospy.Subscriber("other", LaserScan, lambda message: rospy.wait_for_service("lambda"))
if __name__ == "__main__":
    main()
"""


def test_a_wait_in_a_callback_is_no_precondition(workspace: Workspace) -> None:
    """The module is active by then; what its constructor reaches by calls is waited for before."""
    found = workspace.package({"src/n.cpp": INCLUDE + WAITS}).modules()["ecm.pkg.n"]
    assert value(found.behavior.preconditions) == ["message_received ready"]


def test_a_wait_in_a_callback_of_python(workspace: Workspace) -> None:
    """Functions and lambdas that are handed on run later."""
    found = workspace.package({"scripts/n.py": PYTHON_WAITS}, ros=1).modules()
    (node,) = (each for each in found.values() if each.behavior.preconditions is not None)
    assert value(node.behavior.preconditions) == ["service_available early"]


def test_lifecycle_node_works_when_active(workspace: Workspace) -> None:
    """A managed node has a state to be in, and one to go back to."""
    found = contract(workspace, "", "rclcpp_lifecycle::LifecycleNode")
    assert value(found.behavior.preconditions) == ["lifecycle_state == active"]
    assert value(found.recovery.rollback_state) == "inactive"


@pytest.mark.parametrize("imported", ["LifecycleNode", "LifecycleNode as Node", "Node"])
def test_lifecycle_node_of_python(workspace: Workspace, imported: str) -> None:
    """rclpy gives the class two names."""
    name = imported.rpartition(" ")[2]
    text = f"import rclpy\nfrom rclpy.lifecycle import {imported}\n\nclass N({name}):\n"
    text += "    def __init__(self):\n        super().__init__('n')\n"
    found = workspace.package({"pkg/n.py": text}).modules()["ecm.pkg.n"]
    assert value(found.behavior.preconditions) == ["lifecycle_state == active"]


def test_a_plain_node_of_python_has_no_state(workspace: Workspace) -> None:
    text = "import rclpy\nfrom rclpy.node import Node\n\nclass N(Node):\n"
    text += "    def __init__(self):\n        super().__init__('n')\n"
    assert workspace.package({"pkg/n.py": text}).modules()["ecm.pkg.n"].behavior.preconditions is None
