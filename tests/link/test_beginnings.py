"""What members of a class begin with, where the class declares them."""

from __future__ import annotations

from typing import Any

import pytest

CPP1 = """
#include <ros/ros.h>
class Camera {{
 public:
  {constructor}
  void on_scan(const sensor_msgs::LaserScanConstPtr & msg);
 private:
  ros::NodeHandle nh_;
  {member}
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "camera");
  Camera camera;
}}
"""
CPP2 = """
#include <rclcpp/rclcpp.hpp>
class Camera : public rclcpp::Node {{
 public:
  Camera() : rclcpp::Node("camera") {{}}
 private:
  {member}
}};
"""
MEMBERS = [
    (CPP1, 1, 'message_filters::Subscriber<sensor_msgs::Image> image_{nh_, "/rgb" "/image", 3};', "/rgb/image"),
    (CPP1, 1, 'message_filters::Subscriber<sensor_msgs::Image> image_ = {nh_, "left", 3};', "/left"),
    (CPP1, 1, 'ros::Subscriber scan_ = nh_.subscribe("scan", 3, &Camera::on_scan, this);', "/scan"),
    (CPP2, 2, 'message_filters::Subscriber<sensor_msgs::msg::Image> image_{this, "image"};', "/image"),
    (
        CPP2,
        2,
        (
            "rclcpp::Subscription<sensor_msgs::msg::Image>::SharedPtr image_ = "
            'create_subscription<sensor_msgs::msg::Image>("image", 3, [](auto) {});'
        ),
        "/image",
    ),
]


@pytest.mark.parametrize(("wrap", "ros", "member", "name"), MEMBERS, ids=[row[2][:50] for row in MEMBERS])
def test_a_member_that_begins_as_an_endpoint_is_one(
    workspace: Any, wrap: str, ros: int, member: str, name: str
) -> None:
    """What a class gives a member where it declares it is run when an object is made."""
    source = wrap.format(member=member, constructor="Camera() {}")
    entry = workspace.package({"src/camera.cpp": source}, ros).only("subscriber")
    line = next(number for number, text in enumerate(source.splitlines(), 1) if member[:30] in text)
    assert (entry.name, entry.evidence[0].line) == (name, line)


def test_what_each_constructor_gives_a_member_is_its_only_beginning(workspace: Any) -> None:
    """A member in the list of every constructor does not begin as its declaration says."""
    member = 'message_filters::Subscriber<sensor_msgs::Image> image_{nh_, "declared", 3};'
    constructor = 'Camera() : Camera(1) {} explicit Camera(int depth) : image_(nh_, "given", depth) {}'
    source = CPP1.format(member=member, constructor=constructor)
    assert workspace.package({"src/camera.cpp": source}, 1).only("subscriber").name == "/given"
