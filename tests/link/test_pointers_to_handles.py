"""Pointers to handles that are written out: what they point to is the handle that they are made of."""

from __future__ import annotations

from typing import Any

import pytest

POINTED = """
#include <ros/ros.h>
#include <image_transport/image_transport.h>
class Talker {{
 public:
  Talker() : nh_("~") {{ {made} pub_ = {held}->advertise{kind}("out", 1); }}
  ros::NodeHandle nh_;
  std::shared_ptr<image_transport::ImageTransport> it_;
  boost::shared_ptr<ros::NodeHandle> sub_;
  ros::NodeHandlePtr ptr_;
}};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "demo"); Talker talker; ros::spin(); }}
"""
TRANSPORT = "image_transport::ImageTransport"
POINTERS = [
    (f"it_ = std::shared_ptr<{TRANSPORT}>(new {TRANSPORT}(nh_));", "it_", "", "/demo/out"),
    (f"std::shared_ptr<{TRANSPORT}> it(new {TRANSPORT}(nh_));", "it", "", "/demo/out"),
    (f"auto it = std::unique_ptr<{TRANSPORT}>(new {TRANSPORT}(nh_));", "it", "", "/demo/out"),
    (
        'sub_ = boost::shared_ptr<ros::NodeHandle>(new ros::NodeHandle("sub"));',
        "sub_",
        "<std_msgs::String>",
        "/sub/out",
    ),
    ('ptr_ = ros::NodeHandlePtr(new ros::NodeHandle("~sub"));', "ptr_", "<std_msgs::String>", "/demo/sub/out"),
]


@pytest.mark.parametrize(("made", "held", "kind", "name"), POINTERS, ids=[row[0] for row in POINTERS])
def test_a_pointer_that_is_written_out_points_to_the_handle_that_it_is_made_of(
    workspace: Any, made: str, held: str, kind: str, name: str
) -> None:
    """`std::shared_ptr<T>(new T(nh))` and the like are what they are given, as `reset(new T(nh))` is."""
    files = {"src/demo.cpp": POINTED.format(made=made, held=held, kind=kind)}
    assert workspace.package(files, ros=1).only("publisher").name == name
