"""Behavior that endpoints show: QoS per topic."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from ecm_checker.contract import Behavior, Interface, Value


def behavior_of(interfaces: Sequence[Interface]) -> Behavior:
    """Return the behavior section of a module; without topics its QoS stays undeclared."""
    profiles = {
        f"{entry.role} {entry.name}": msgspec.to_builtins(entry.qos) for entry in interfaces if entry.qos is not None
    }
    if not profiles:
        return Behavior()
    evidence = tuple(entry.evidence[0] for entry in interfaces if entry.qos is not None)
    return Behavior(qos=Value(profiles, "inferred", "folded", evidence))
