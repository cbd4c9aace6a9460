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
MADE_ELSEWHERE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Tool : public rclcpp::Node {
public:
  explicit Tool(const std::string & topic = "") : Node("tool") {
    if (!topic.empty()) { create_publisher<std_msgs::msg::String>(topic, 10); }
  }
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); %s }
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


def test_who_makes_an_object_may_give_an_empty_default_a_name(workspace: Any) -> None:
    """Nothing was told of what only those who make the object with a name have; a default that holds makes nothing."""
    open_ = workspace.package({"src/n.cpp": MADE_ELSEWHERE % "spin_all(&make<Tool>);"}).interfaces()
    assert [(one.raw_name, one.confidence) for one in open_ if one.role == "publisher"] == [("{topic}", "pattern")]
    made = workspace.package({"src/n.cpp": MADE_ELSEWHERE % "rclcpp::spin(std::make_shared<Tool>());"}).interfaces()
    assert [one.raw_name for one in made if one.role == "publisher"] == []


def test_an_empty_default_makes_no_name_of_a_slash(workspace: Any) -> None:
    """`"/" + sensor`, where the parameter is empty unless somebody sets it: ROS has no such name."""
    text = """
#include <rclcpp/rclcpp.hpp>
class N : public rclcpp::Node {
public:
  N() : Node("n") {
    std::string sensor = declare_parameter("sensor", "");
    create_publisher<std_msgs::msg::String>("/" + sensor, 10);
    create_publisher<std_msgs::msg::String>(sensor + "/state", 10);
  }
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<N>()); }
"""
    found = workspace.package({"src/n.cpp": text}).interfaces()
    assert sorted(one.name for one in found if one.role == "publisher") == ["/state", "/{sensor}"]
