"""A camera of image_transport is two endpoints: the image and `camera_info` in its namespace."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.link.folding.placing import CAMERA_INFO, placed
from ecm_extract.link.running.values import Hole, Value

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
    (("/left/image_raw",), "/left/camera_info"),
    (("image_raw",), "camera_info"),
    (("~image_raw",), "~camera_info"),
    (("~/image_raw",), "~/camera_info"),
    (("/", Hole("name"), "/image_raw"), "/{name}/camera_info"),
    (("/left/", Hole("topic")), "/{camera_info}"),
    ((Hole("topic"),), "{camera_info}"),
    ((Hole("side"), "_raw"), "{camera_info}"),
    (("~", Hole("topic")), "~{camera_info}"),
    (("~/", "", "image_raw"), "~/camera_info"),
    (("/", Hole("name"), "/", "image_raw"), "/{name}/camera_info"),
    (("left_", Hole("side"), "image", "_raw"), "{camera_info}"),
]


@pytest.mark.parametrize(("body", "role", "names"), ROWS, ids=[row[0] for row in ROWS])
def test_camera_info_is_beside_the_image(workspace: Any, body: str, role: str, names: set[str]) -> None:
    """Both have the queue of the call; each has its type."""
    found = workspace.package({"src/d.cpp": CPP.format(body=body)}, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == role} == names
    types = {entry.name.rpartition("/")[2]: entry.type for entry in found}
    assert types.get("camera_info", "sensor_msgs/msg/CameraInfo") == "sensor_msgs/msg/CameraInfo"
    assert len({entry.qos.depth for entry in found}) == 1


def test_camera_info_is_beside_an_image_that_callers_name(workspace: Any) -> None:
    """What a helper is given is followed to its callers for both."""
    helper = "void take(image_transport::ImageTransport & it, std::string topic) {{ it.subscribeCamera(topic, 1, f); }}"
    source = CPP.replace("int main", f"{helper}\nint main").format(body='take(it, "left/image_raw");')
    found = workspace.package({"src/d.cpp": source}, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "subscriber"} == {"/left/image_raw", "/left/camera_info"}


@pytest.mark.parametrize(("name", "second"), NAMES, ids=[row[1] for row in NAMES])
def test_a_name_beside_another(name: tuple[str | Hole, ...], second: str) -> None:
    """A hole at the end may hold a namespace, so that the name beside it is not known."""
    assert placed(Value(name, "default"), CAMERA_INFO).text == second


def test_a_name_beside_another_is_as_sure() -> None:
    """What holds by default holds by default beside it."""
    assert placed(Value(("image",), "default"), CAMERA_INFO) == Value(("camera_info",), "default")
