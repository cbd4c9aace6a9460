"""What is told of the policies of an endpoint that several lines make, and of variables that nobody shows."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.contract import Qos

CPP = """
#include <rclcpp/rclcpp.hpp>
class D : public rclcpp::Node {{
public:
  D() : Node("d") {{
    {body}
  }}
}};
int main(int argc, char ** argv) {{ rclcpp::spin(std::make_shared<D>()); }}
"""
MAKES = 'create_publisher<std_msgs::msg::String>("out", {qos});'

ROWS = [
    ("rclcpp::QoS(1)", "rclcpp::QoS(1)", Qos("reliable", "volatile", "keep_last", 1), False),
    ("rclcpp::QoS(1)", "rclcpp::QoS(8)", Qos("reliable", "volatile", "keep_last", None), False),
    ("rclcpp::QoS(1)", "rclcpp::QoS(1).best_effort()", Qos("unknown", "volatile", "keep_last", 1), True),
    ("rclcpp::QoS(1).transient_local()", "rclcpp::QoS(1)", Qos("reliable", "unknown", "keep_last", 1), True),
]


@pytest.mark.parametrize(("first", "second", "expected", "is_set"), ROWS)
def test_policies_of_two_makers(workspace: Any, first: str, second: str, expected: Qos, is_set: bool) -> None:
    """What both set alike is told, what they set differently is unknown, whichever line comes first."""
    for one, other in ((first, second), (second, first)):
        body = f"auto a = {MAKES.format(qos=one)}\n    auto b = {MAKES.format(qos=other)}"
        found = workspace.package({"src/d.cpp": CPP.format(body=body)}).only("publisher").qos
        assert (found.reliability, found.durability, found.depth) == (
            expected.reliability,
            expected.durability,
            expected.depth,
        )
        assert ("reliability" in found.defaulted and "durability" in found.defaulted) is not is_set


def test_a_queue_that_nobody_shows_beside_one_that_is_written(workspace: Any) -> None:
    """In ROS 1 a queue that is not known takes no length from another line."""
    text = """
    #include <ros/ros.h>
    int main(int argc, char ** argv) {
      ros::init(argc, argv, "d");
      ros::NodeHandle nh;
      auto a = nh.advertise<std_msgs::String>("out", 3);
      auto b = nh.advertise<std_msgs::String>("out", length());
    }
    """
    assert workspace.package({"src/d.cpp": text}, ros=1).only("publisher").qos is None


def test_a_field_of_an_own_struct_is_no_parameter(workspace: Any) -> None:
    """A struct of the tree whose name ends like that of generated parameters holds what it is given."""
    text = """
    #include <rclcpp/rclcpp.hpp>
    struct DriverParams { std::string topic; };
    class D : public rclcpp::Node {
    public:
      D(DriverParams params) : Node("d") {
        declare_parameter("topic", "asked");
        auto a = create_publisher<std_msgs::msg::String>(params.topic, 1);
      }
    };
    int main(int argc, char ** argv) {
      DriverParams params;
      params.topic = "given";
      rclcpp::spin(std::make_shared<D>(params));
    }
    """
    assert workspace.package({"src/d.cpp": text}).only("publisher").name == "/given"
