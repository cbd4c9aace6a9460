"""What a client of another node's parameters reads is none of the node that asks."""

from __future__ import annotations

from typing import Any

SOURCE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class N : public rclcpp::Node {
public:
  N(const rclcpp::NodeOptions & options) : Node("n", options) {
    client_ = std::make_shared<rclcpp::SyncParametersClient>(this, "other");
    debug_ = client_->get_parameter<bool>("mode.debug");
    auto local = std::make_shared<rclcpp::SyncParametersClient>(this, "third");
    std::string topic = local->get_parameter<std::string>("config.topic");
    if (debug_) { create_publisher<std_msgs::msg::String>("a", 10); }
    create_publisher<std_msgs::msg::String>(topic, 10);
    own_ = get_parameter("own").as_string();
  }
  std::shared_ptr<rclcpp::SyncParametersClient> client_;
  bool debug_;
  std::string own_;
};
class M : public rclcpp::Node {
public:
  M() : Node("m") { declare_parameter("mode.debug", true); declare_parameter("config.topic", "scan"); }
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::NodeOptions options;
  options.automatically_declare_parameters_from_overrides(true);
  rclcpp::spin(std::make_shared<N>(options));
  rclcpp::spin(std::make_shared<M>());
}
"""


def test_a_client_reads_parameters_of_another_node(workspace: Any) -> None:
    """They are no parameters of the asking node, no default of a namesake gives their value, no condition names them."""
    found = workspace.package({"src/n.cpp": SOURCE}).interfaces()
    assert sorted((one.name, str(one.default)) for one in found if one.role == "parameter") == [
        ("config.topic", "scan"), ("mode.debug", "True"), ("own", "None"),
    ]  # fmt: skip
    told = {one.name: (one.confidence, [each.tests for each in one.when]) for one in found if one.role == "publisher"}
    assert told == {"/a": ("literal", ["expression"]), "/{topic}": ("pattern", [])}
