"""Objects of structures that constructors and functions are given: their fields are what the giver made them."""

from __future__ import annotations

from typing import Any

import pytest

KEEPER = """
class Lidar {
 public:
  Lidar(rclcpp::Node * node, const Info & info) : node_(node), info_(info) {}
  void open() { publisher_ = node_->create_publisher<std_msgs::msg::String>(info_.cloud.topic, 1); }
  rclcpp::Node * node_;
  Info info_;
};
"""
OPENER = """
void open(rclcpp::Node * node, const Cloud & cloud) { node->create_publisher<std_msgs::msg::String>(cloud.topic, 1); }
"""
DEMO = """
#include <rclcpp/rclcpp.hpp>
struct Cloud {{ std::string frame; std::string topic; }};
struct Info {{ int host; Cloud cloud; }};
{taker}
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{
    auto topic = declare_parameter<std::string>("topic", "~/out");
    {body}
  }}
  std::unique_ptr<Lidar> lidar_;
}};
"""
MADE = "lidar_ = std::make_unique<Lidar>(this, info); lidar_->open();"
TWO = """Info info{1, Cloud{"f", "a"}}; Info other{1, Cloud{"f", "b"}};
    Lidar left(this, info); left.open(); Lidar right(this, other); right.open();"""
ROWS = [
    ('Info info{1, Cloud{"f", "a"}}; ' + MADE, ["/a"]),
    ('Info info{1, Cloud{"f", topic}}; ' + MADE, ["/demo/out"]),
    (TWO, ["/a", "/b"]),
    ('Info info; info.cloud.topic = "a"; ' + MADE, ["/a"]),
    ('Cloud cloud; cloud.topic = "a"; open(this, cloud);', ["/a"]),
    ('Cloud cloud; cloud.topic = "a"; if (get_name()) { cloud.topic = "b"; } open(this, cloud);', ["/a", "/b"]),
]
UNTOLD = [
    'Cloud cloud; cloud.topic = "a"; fill(cloud); open(this, cloud);',
    "Info info = outside(); " + MADE,
    'Info info{1, Cloud{"f", "a"}}; lidar_ = std::make_unique<Lidar>(this, info); lidar_->info_.cloud.topic = "z"; lidar_->open();',
]


def _published(workspace: Any, body: str) -> list[Any]:
    taker = KEEPER if "idar" in body else OPENER
    found = workspace.package({"src/demo.cpp": DEMO.format(taker=taker, body=body)}).interfaces()
    return [entry for entry in found if entry.role == "publisher"]


@pytest.mark.parametrize(("body", "names"), ROWS, ids=[row[0][:50] for row in ROWS])
def test_fields_of_what_is_handed_on_are_those_that_the_giver_made(workspace: Any, body: str, names: list[str]) -> None:
    """In braces or one by one, through parameters of constructors, members and copies."""
    assert sorted(entry.name for entry in _published(workspace, body)) == names


@pytest.mark.parametrize("body", UNTOLD, ids=[row[:50] for row in UNTOLD])
def test_what_somebody_may_have_changed_is_not_told(workspace: Any, body: str) -> None:
    """A function that nobody sees gets the object, or somebody reaches into the one that keeps it."""
    assert {entry.confidence for entry in _published(workspace, body)} == {"pattern"}
