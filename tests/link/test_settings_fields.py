"""Names held in structures of settings, empty names, and names resolved by roscpp."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
struct Settings {{ std::string topic; std::string other; }};
void fill(Settings & given) {{ given.topic = "filled"; }}
class Demo {{
 public:
  Demo() : pnh_("~") {{
    read();
    {body}
  }}
  void read() {{ auto [held, guard]{{box_.data()}}; pnh_.param("scan_topic", held.topic_, std::string("scan")); }}
  void send(const std::string & topic = "") {{ if (topic != "") {{ auto p = nh_.advertise<std_msgs::Bool>(topic, 1); }} }}
  ros::NodeHandle nh_, pnh_;
  Settings settings_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "demo"); Demo demo; }}
"""
ROWS = [
    ("nh_.advertise<std_msgs::Bool>(parameters.topic_, 1);", {"/scan"}),
    ('Settings s; s.topic = "own"; nh_.advertise<std_msgs::Bool>(s.topic, 1);', {"/own"}),
    ("Settings s; fill(s); nh_.advertise<std_msgs::Bool>(s.topic, 1);", {"/filled"}),
    ('settings_.topic = "kept"; nh_.advertise<std_msgs::Bool>(settings_.topic, 1);', {"/kept"}),
    ('settings_.topic = "kept"; nh_.advertise<std_msgs::Bool>(settings_.other, 1);', {"/{other}"}),
    ('Other o; o.topic = "x"; nh_.advertise<std_msgs::Bool>(settings_.topic, 1);', {"/{topic}"}),
    ('pnh_.advertise<std_msgs::Bool>(ros::names::resolve("imu") + "/data", 1);', {"/imu/data"}),
    ("nh_.advertise<std_msgs::Bool>(ros::names::resolve(settings_.topic), 1);", {"/{topic}"}),
    (
        'nh_.advertise<std_msgs::Bool>(ros::names::clean("left/" + nh_.resolveName("image")), 1);',
        {"/left/{node namespace}/image"},
    ),
    ("send();", set()),
    ('ros::NodeHandle image(nh_, "image"); image.advertise<std_msgs::Bool>("", 1);', {"/image"}),
    ('send(); send("said");', {"/said"}),
]


@pytest.mark.parametrize(("body", "names"), ROWS, ids=[row[0][:50] for row in ROWS])
def test_fields_hold_what_is_written_to_them(workspace: Any, body: str, names: set[str]) -> None:
    """A field of settings is what methods, helpers or parameters write to it; an empty name is never made."""
    found = workspace.package({"src/d.cpp": TEXT.format(body=body)}, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "publisher"} == names
