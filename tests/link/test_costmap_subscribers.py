"""Subscribers of nav2_costmap_2d subscribe to the topic that they are given, for the node that they are given."""

from __future__ import annotations

from typing import Any

SOURCE = """
#include <nav2_util/lifecycle_node.hpp>
#include <nav2_costmap_2d/costmap_subscriber.hpp>
#include <nav2_costmap_2d/footprint_subscriber.hpp>
class N : public nav2_util::LifecycleNode {
public:
  N() : nav2_util::LifecycleNode("n", "") { declare_parameter("topic", "local_costmap/costmap_raw"); }
  nav2_util::CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {
    std::string topic;
    get_parameter("topic", topic);
    costmap_ = std::make_unique<nav2_costmap_2d::CostmapSubscriber>(shared_from_this(), topic);
    footprint_ = std::make_unique<nav2_costmap_2d::FootprintSubscriber>(shared_from_this(), "footprint", *tf_, "base");
    return nav2_util::CallbackReturn::SUCCESS;
  }
  std::unique_ptr<nav2_costmap_2d::CostmapSubscriber> costmap_;
  std::unique_ptr<nav2_costmap_2d::FootprintSubscriber> footprint_;
  std::shared_ptr<tf2_ros::Buffer> tf_;
};
int main(int argc, char ** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<N>()->get_node_base_interface()); }
"""


def test_a_costmap_and_a_footprint_are_subscribed(workspace: Any) -> None:
    """A reader of Nav2 knows their messages; the node that makes them has the subscription."""
    found = workspace.package({"src/n.cpp": SOURCE}).interfaces()
    assert {(one.name, one.type) for one in found if one.role == "subscriber"} == {
        ("/local_costmap/costmap_raw", "nav2_msgs/msg/Costmap"),
        ("/footprint", "geometry_msgs/msg/PolygonStamped"),
    }
