"""A condition names the parameter that it asks for, with what a handle puts before it."""

from __future__ import annotations

from typing import Any

BELOW = """
#include <ros/ros.h>
class Device {
public:
  Device(const std::string & name, ros::NodeHandle & pnh) : nh_(ros::NodeHandle(pnh, "devices/" + name)), markers_(false) {
    nh_.getParam("body/markers", markers_);
    if (markers_) pub_ = nh_.advertise<visualization_msgs::Marker>("body/shown", 1);
  }
  ros::NodeHandle nh_; ros::Publisher pub_; bool markers_;
};
int main(int argc, char ** argv) {
  ros::init(argc, argv, "demo");
  ros::NodeHandle pnh("~");
  std::string name = argv[1];
  Device device(name, pnh);
  ros::spin();
}
"""


def test_a_condition_has_the_whole_name_of_its_parameter(workspace: Any) -> None:
    """Of `body/markers` that a handle reads below a device it is the parameter of that device that decides."""
    workspace.package({"src/demo.cpp": BELOW}, ros=1)
    shown, read = workspace.only("publisher"), workspace.only("parameter")
    assert read.name.startswith("/demo/devices/")
    assert [(each.tests, each.name) for each in shown.when] == [("parameter", read.name)]
