"""What is empty where a name or a value is asked for."""

from __future__ import annotations

from typing import Any

NAMED = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Base : public rclcpp::Node {
public:
  Base(const std::string & space) : Node("n", space) {}
  void start() { initialize(); }
protected:
  virtual void initialize() = 0;
  std::string topic_;
};
class Lidar : public Base {
public:
  Lidar(const std::string & space) : Base(space) { topic_ = "scan"; start(); }
private:
  void initialize() override { create_publisher<std_msgs::msg::String>(topic_, 10); }
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Lidar>(argv[1])); }
"""
DYNAMIC = """
#include <rclcpp/rclcpp.hpp>
class N : public rclcpp::Node {
public:
  N() : Node("n") {
    rcl_interfaces::msg::ParameterDescriptor any;
    any.dynamic_typing = true;
    declare_parameter("index", rclcpp::ParameterValue{}, any);
    declare_parameter("other", rclcpp::ParameterValue(), any);
    create_publisher<std_msgs::msg::String>(get_parameter("other").as_string(), 10);
  }
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<N>()); }
"""


def test_ros_2_has_no_endpoint_without_a_name(workspace: Any) -> None:
    """What a member holds before the constructor gives it a name is none, in whatever namespace the node is."""
    found = workspace.package({"src/n.cpp": NAMED}).interfaces()
    assert {one.raw_name for one in found if one.role == "publisher"} == {"scan"}


def test_a_value_of_no_type_is_no_text(workspace: Any) -> None:
    """`rclcpp::ParameterValue{}` is not set: a parameter of any type was told as an empty text."""
    found = workspace.package({"src/n.cpp": DYNAMIC}).interfaces()
    told = {(one.name, one.type, one.default) for one in found}
    assert told == {("index", None, None), ("other", None, None), ("/{other}", "std_msgs/msg/String", None)}
