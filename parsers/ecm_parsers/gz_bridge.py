"""Topics that ros_gz_bridge carries between ROS and gz: its YAML file and its command line.

Source: the README of ros_gz_bridge ("Configuring the bridge via YAML", "Bridge communication").
"""

from __future__ import annotations

import re
from typing import Literal

import msgspec

from ecm_parsers.result import Parsed
from ecm_parsers.yaml_tree import Mapping, Scalar, Sequence, parse_yaml

Direction = Literal["bidirectional", "gz_to_ros", "ros_to_gz"]
_SIGNS: dict[str, Direction] = {"@": "bidirectional", "[": "gz_to_ros", "]": "ros_to_gz"}
_ARGUMENT = re.compile(r"(?P<topic>[^@\s]+)@(?P<type>[\w/]+)(?P<sign>[@\[\]])(?P<gz>[\w.]+)")


class BridgedTopic(msgspec.Struct, frozen=True):
    """One topic: its ROS name and type, which way it goes, 1-based line (0 on a command line)."""

    name: str
    type: str
    direction: Direction
    line: int = 0


def parse_bridge_yaml(data: bytes) -> Parsed[tuple[BridgedTopic, ...]]:
    """Read the configuration file of a bridge."""
    tree = parse_yaml(data)
    found = [
        topic
        for document in tree.facts
        for item in (document.items if isinstance(document, Sequence) else ())
        if isinstance(item, Mapping) and (topic := _topic(item)) is not None
    ]
    return Parsed(tuple(found), tree.diagnostics)


def bridged_argument(word: str) -> BridgedTopic | None:
    """Read one word of the command line, `/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan`; None for another."""
    match = _ARGUMENT.fullmatch(word)
    return None if match is None else BridgedTopic(match["topic"], match["type"], _SIGNS[match["sign"]])


def _topic(item: Mapping) -> BridgedTopic | None:
    name = _text(item, "ros_topic_name") or _text(item, "topic_name") or _text(item, "gz_topic_name")
    kind = _text(item, "ros_type_name")
    if not name or not kind:
        return None
    written = _text(item, "direction").lower().replace("ign", "gz")
    direction: Direction = (
        "gz_to_ros" if written == "gz_to_ros" else "ros_to_gz" if written == "ros_to_gz" else "bidirectional"
    )
    return BridgedTopic(name, kind, direction, item.line)


def _text(item: Mapping, key: str) -> str:
    value = item.get(key)
    return value.text if isinstance(value, Scalar) else ""
