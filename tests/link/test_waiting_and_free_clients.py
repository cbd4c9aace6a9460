"""Functions of the client libraries that make an endpoint by themselves."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import rclpy
from rclpy.wait_for_message import wait_for_message
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String
def main():
    rclpy.init()
    node = rclpy.create_node("n")
    found, message = wait_for_message({arguments})
"""
ROWS = [
    ('String, node, "in"', ("reliable", 1)),
    ('msg_type=String, node=node, topic="in"', ("reliable", 1)),
    ('String, node, "in", qos_profile=qos_profile_sensor_data', ("best_effort", 5)),
    ('String, node, "in", qos_profile=3, time_to_wait=1.0', ("reliable", 3)),
]


@pytest.mark.parametrize(("arguments", "qos"), ROWS, ids=[row[0] for row in ROWS])
def test_waiting_for_a_message_subscribes(workspace: Any, arguments: str, qos: tuple[str, int]) -> None:
    """rclpy subscribes until a message came, to a queue of one where no profile is given."""
    found = workspace.package({"pkg/d.py": PYTHON.format(arguments=arguments)}).only("subscriber")
    assert (found.name, found.type) == ("/in", "std_msgs/msg/String")
    assert (found.qos.reliability, found.qos.depth) == qos


def test_a_free_function_of_roscpp_makes_a_client(workspace: Any) -> None:
    """`ros::service::createClient` needs no handle."""
    text = 'int main() { auto client = ros::service::createClient<std_srvs::Empty>("reset"); }'
    found = workspace.package({"src/d.cpp": text}, ros=1).only("service_client")
    assert (found.name, found.type) == ("/reset", "std_srvs/srv/Empty")
