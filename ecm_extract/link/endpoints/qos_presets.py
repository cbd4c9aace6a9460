"""Profiles of QoS that client libraries have by name, and what two profiles have in common."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from types import MappingProxyType
from typing import Any

from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.shipped import shipped

UNSEEN: Mapping[str, Any] = MappingProxyType(
    {"reliability": "unknown", "durability": "unknown", "history": "unknown", "depth": None}
)
"""Policies that source sets to what the tree does not show."""
DEFAULT = "qos_profile_default"
"""What an endpoint has whose source sets nothing."""


@cache
def presets() -> Mapping[str, tuple[str, Mapping[str, Any]]]:
    """Return preset name as written -> (profile, policies)."""
    table = shipped("link/endpoints/qos_presets.toml")
    return {
        name: (profile, {key: value for key, value in row.items() if key != "names"})
        for profile, row in table.items()
        for name in row["names"]
    }


def preset_of(written: str) -> dict[str, Any]:
    """Return what a variable begins with that is only declared: `rclcpp::SensorDataQoS qos;` is a preset by its type.

    What it is made with is a queue, and what it is given is such a preset, too: only what is set counts beside it.
    """
    preset = presets().get(last_name(plain(written))) if written else None
    return {**preset[1], "profile": preset[0]} if preset is not None else {}


def agreed(sides: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Return what all sides of a choice set alike; what they set differently is unknown."""
    default = presets()[DEFAULT][1]
    values = {
        key: {side.get(key, default.get(key)) for side in sides} for key in dict.fromkeys(k for s in sides for k in s)
    }
    return {key: found.pop() if len(found) == 1 else UNSEEN.get(key) for key, found in values.items()}
