"""Handlers of parameter events subscribe to what all nodes say of their parameters."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
class N : public rclcpp::Node {{
public:
  N() : Node("n"){init} {{ {body} }}
  {member}
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<N>()); }}
"""
PYTHON = """
from rclpy.node import Node
from rclpy.parameter_event_handler import ParameterEventHandler
class D(Node):
    def __init__(self):
        super().__init__('d')
        self.handler = ParameterEventHandler(self)
"""
ROWS = [
    ("shared", {"init": "", "body": "h_ = std::make_shared<rclcpp::ParameterEventHandler>(this);", "member": ""}),
    ("member", {"init": ", h_(this)", "body": "", "member": "rclcpp::ParameterEventHandler h_;"}),
    ("earlier", {"init": "", "body": "h_ = std::make_shared<rclcpp::ParameterEventsSubscriber>(this);", "member": ""}),
]
FILES = [{"src/n.cpp": NODE.format(**parts)} for _, parts in ROWS] + [{"pkg/d.py": PYTHON}]


@pytest.mark.parametrize("files", FILES, ids=[*(row[0] for row in ROWS), "python"])
def test_a_handler_of_parameter_events_subscribes(workspace: Any, files: dict[str, str]) -> None:
    """The topic is the same for every node, wherever it stands, with the profile that rmw has for it."""
    found = workspace.package(files).only("subscriber")
    assert (found.name, found.type) == ("/parameter_events", "rcl_interfaces/msg/ParameterEvent")
    assert (found.qos.depth, found.qos.reliability) == (1000, "reliable")


def test_a_handler_takes_another_profile(workspace: Any) -> None:
    """A profile that is given is the subscription's."""
    body = "h_ = std::make_unique<rclcpp::ParameterEventHandler>(*this, rclcpp::SensorDataQoS());"
    found = workspace.package({"src/n.cpp": NODE.format(init="", body=body, member="")}).only("subscriber")
    assert (found.qos.depth, found.qos.reliability) == (5, "best_effort")
