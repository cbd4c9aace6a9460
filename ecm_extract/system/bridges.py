"""Endpoints of a bridge between ROS and gz, from its command line and its configuration file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from ecm_checker.hub.roles import Role
from ecm_parsers.gz_bridge import BridgedTopic, bridged_argument, parse_bridge_yaml

from ecm_extract.system.files import Files
from ecm_extract.system.model import Instance, Place
from ecm_extract.system.programs import programs

_ROLES: Final[Mapping[str, tuple[Role, ...]]] = {
    "gz_to_ros": ("publisher",),
    "ros_to_gz": ("subscriber",),
    "bidirectional": ("publisher", "subscriber"),
}


def bridged(instance: Instance, files: Files) -> Iterator[tuple[Role, BridgedTopic, Place]]:
    """Yield (role, topic, line) of what an instance carries, when it is a bridge."""
    if instance.executable not in programs().bridge.executables:
        return
    for word in instance.arguments:
        topic = bridged_argument(word.text)
        if topic is not None:
            yield from ((role, topic, instance.place) for role in _ROLES[topic.direction])
        elif word.text.startswith("config_file:="):
            yield from _of_file(word.text.partition(":=")[2], files)
    for setting in instance.settings:
        if setting.name == "config_file" and isinstance(setting.value, str):
            yield from _of_file(setting.value, files)


def _of_file(text: str, files: Files) -> Iterator[tuple[Role, BridgedTopic, Place]]:
    path = files.find(text)
    data = files.read(path) if path is not None else None
    if path is None or data is None:
        return
    for topic in parse_bridge_yaml(data).facts:
        yield from ((role, topic, Place(path, topic.line)) for role in _ROLES[topic.direction])
