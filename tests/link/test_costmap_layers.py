"""A layer of a costmap declares its parameters below its own name, through a method of its base in nav2_costmap_2d."""

from __future__ import annotations

from typing import Any

SOURCE = """
#include <nav2_costmap_2d/costmap_layer.hpp>
#include <pluginlib/class_list_macros.hpp>
namespace own {
class Scans : public nav2_costmap_2d::CostmapLayer {
public:
  void onInitialize() override {
    declareParameter("topic", rclcpp::ParameterValue("points"));
    declareParameter("height", rclcpp::ParameterValue(2.0));
    this->declareParameter("frames", rclcpp::PARAMETER_STRING_ARRAY);
    auto node = node_.lock();
    node->get_parameter(name_ + "." + "topic", topic_);
    sub_ = node->create_subscription<sensor_msgs::msg::PointCloud2>(topic_, 1, std::bind(&Scans::take, this));
  }
  std::string topic_;
};
class Other : public own_base::Base {
public:
  void onInitialize() { declareParameter("no", rclcpp::ParameterValue(1)); }
};
}
PLUGINLIB_EXPORT_CLASS(own::Scans, nav2_costmap_2d::Layer)
PLUGINLIB_EXPORT_CLASS(own::Other, own_base::Base)
"""


def test_a_layer_declares_below_its_name(workspace: Any) -> None:
    """The name is the host's; what reads the parameter below that name has its default. Other bases are not known."""
    found = workspace.package({"src/n.cpp": SOURCE}).interfaces()
    assert {(one.name, one.type, one.default) for one in found if one.role == "parameter"} == {
        ("{name}.topic", "string", "points"),
        ("{name}.height", "double", 2.0),
        ("{name}.frames", "string_array", None),
    }
    assert [(one.name, one.confidence) for one in found if one.role == "subscriber"] == [("/points", "default")]
