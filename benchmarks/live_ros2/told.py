"""What ROS 2 itself told of the nodes that ran, as an observation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import msgspec
from ecm_checker.contract import Qos

from ecm_extract.observe.actions import with_actions
from ecm_extract.observe.model import Endpoint, Gap, Node, Observation, Parameter, Sense

SENSES: Sequence[Sense] = (
    "node",
    "publisher",
    "subscriber",
    "service_server",
    "service_client",
    "action_server",
    "action_client",
    "parameter",
    "qos",
)


def observation(document: Mapping[str, Any]) -> Observation:
    """The document of programs/asker.py."""
    policies = {(each["role"], each["name"], each["node"]): each for each in document["qos"]}
    return Observation(
        source="dds",
        target="rclpy",
        ros=2,
        begun="",
        seconds=0,
        senses=tuple(SENSES),
        nodes=tuple(map(Node, document["nodes"])),
        endpoints=with_actions(_endpoints(document["nodes"], policies), 2),
        parameters=tuple(_parameters(document["parameters"])),
        gaps=tuple(Gap(node, "tells no parameters") for node, told in document["parameters"].items() if told is None),
    )


def _endpoints(nodes: Mapping[str, Any], policies: Mapping[tuple[str, str, str], Any]) -> Iterator[Endpoint]:
    for node, roles in nodes.items():
        for role, ends in roles.items():
            for name, kind in ends:
                told = policies.get((role, name, node))
                yield Endpoint(role, name, kind, node, qos=_qos(told) if told is not None else None)


def _qos(told: Mapping[str, Any]) -> Qos:
    fields = {each.name for each in msgspec.structs.fields(Qos)}
    return Qos(**{key: value for key, value in told.items() if key in fields})


def _parameters(told: Mapping[str, Mapping[str, Any] | None]) -> Iterator[Parameter]:
    for node, values in told.items():
        for name, value in (values or {}).items():
            yield Parameter(name, value, node)
