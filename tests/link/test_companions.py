"""A camera of image_transport is two endpoints: the image and `camera_info` in its namespace."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.link.companions import beside

CPP = """
#include <ros/ros.h>
void on_image(const sensor_msgs::ImageConstPtr & image, const sensor_msgs::CameraInfoConstPtr & info);
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  image_transport::ImageTransport it(nh);
  {body}
}}
"""
ROWS = [
    ('auto p = it.advertiseCamera("left/image_raw", 3);', "publisher", {"/left/image_raw", "/left/camera_info"}),
    ('auto s = it.subscribeCamera("image", 1, on_image);', "subscriber", {"/image", "/camera_info"}),
    ('auto p = it.advertise("image", 1);', "publisher", {"/image"}),
]
NAMES = [
    ("/left/image_raw", "/left/camera_info"),
    ("image_raw", "camera_info"),
    ("~image_raw", "~camera_info"),
    ("~/image_raw", "~/camera_info"),
    ("/{name}/image_raw", "/{name}/camera_info"),
    ("/left/{topic}", "/{camera_info}"),
    ("{topic}", "{camera_info}"),
]


@pytest.mark.parametrize(("body", "role", "names"), ROWS, ids=[row[0] for row in ROWS])
def test_camera_info_is_beside_the_image(workspace: Any, body: str, role: str, names: set[str]) -> None:
    """Both have the queue of the call; each has its type."""
    found = workspace.package({"src/d.cpp": CPP.format(body=body)}, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == role} == names
    types = {entry.name.rpartition("/")[2]: entry.type for entry in found}
    assert types.get("camera_info", "sensor_msgs/msg/CameraInfo") == "sensor_msgs/msg/CameraInfo"
    assert len({entry.qos.depth for entry in found}) == 1


@pytest.mark.parametrize(("name", "second"), NAMES, ids=[row[0] for row in NAMES])
def test_a_name_beside_another(name: str, second: str) -> None:
    """A hole at the end may hold a namespace, so that the name beside it is not known."""
    assert beside(name, "camera_info") == second
