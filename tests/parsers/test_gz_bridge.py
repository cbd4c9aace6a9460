"""What a bridge carries, from its file and from its command line."""

from __future__ import annotations

import pytest
from diagnosed import is_told
from ecm_parsers.gz_bridge import BridgedTopic, bridged_argument, parse_bridge_yaml
from hypothesis import given, settings
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("word", "topic"),
    [
        (
            "/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan",
            BridgedTopic("/scan", "sensor_msgs/msg/LaserScan", "gz_to_ros"),
        ),
        (
            "/cmd@geometry_msgs/msg/Twist]ignition.msgs.Twist",
            BridgedTopic("/cmd", "geometry_msgs/msg/Twist", "ros_to_gz"),
        ),
        ("/a@std_msgs/msg/Bool@gz.msgs.Boolean", BridgedTopic("/a", "std_msgs/msg/Bool", "bidirectional")),
        ("--ros-args", None),
        ("a@b", None),
    ],
)
def test_argument(word: str, topic: BridgedTopic | None) -> None:
    """The sign between the types tells the direction."""
    assert bridged_argument(word) == topic


def test_file() -> None:
    """Both spellings of the direction, the short and the long name; an item without a type is left out."""
    text = b"""
- ros_topic_name: odom
  ros_type_name: nav_msgs/msg/Odometry
  gz_type_name: gz.msgs.Odometry
  direction: IGN_TO_ROS
- topic_name: /cmd_vel
  ros_type_name: geometry_msgs/msg/Twist
  direction: ROS_TO_GZ
- topic_name: /none
"""
    assert parse_bridge_yaml(text).facts == (
        BridgedTopic("odom", "nav_msgs/msg/Odometry", "gz_to_ros", 2),
        BridgedTopic("/cmd_vel", "geometry_msgs/msg/Twist", "ros_to_gz", 6),
    )


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="ros_topic:- {}[]@\n", max_size=60))
def test_never_raises(text: str) -> None:
    """No text breaks the parser."""
    assert is_told(text.encode(), parse_bridge_yaml(text.encode()))
    bridged = bridged_argument(text)
    assert bridged is None or bridged.name in text
