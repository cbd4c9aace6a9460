"""Values with the lines that show them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from ecm_checker.contract import Confidence, Evidence, Interface, Value
from ecm_checker.hub.roles import RoleKind, roles

MAX_LINES = 20
_WATCHDOG = re.compile(
    r"cmd_vel_timeout|command_timeout|cmd_timeout|reference_timeout|watchdog|deadman|velocity_timeout|goal_timeout"
)
_RANK: dict[Confidence, int] = {"literal": 0, "folded": 1, "default": 2, "one_of": 3, "pattern": 4}


def inferred(value: Any, evidence: Iterable[Evidence], confidence: Confidence = "literal") -> Value | None:
    """Return a value with its lines; None, which is undeclared, when it is empty."""
    if value is None or value in ({}, [], ""):
        return None
    return Value(value, "inferred", confidence, tuple(dict.fromkeys(evidence))[:MAX_LINES])


def of_interfaces(value: Any, interfaces: Sequence[Interface]) -> Value | None:
    """Return a value that endpoints show, as sure as the least sure of them."""
    confidence: Confidence = max((entry.confidence for entry in interfaces), key=_RANK.__getitem__, default="literal")
    return inferred(value, (entry.evidence[0] for entry in interfaces if entry.evidence), confidence)


def last_told(interfaces: Sequence[Interface], told: Callable[[RoleKind], str]) -> Value | None:
    """Return what the last row of the roles of a module tells of it, with its endpoints of that role."""
    for role, row in reversed(roles().items()):
        found = [entry for entry in interfaces if entry.role == role] if told(row) else []
        if found:
            return of_interfaces(told(row), found)
    return None


def parameters_where(interfaces: Iterable[Interface], wanted: Callable[[str], bool]) -> list[Interface]:
    """Return the parameters whose last name part is wanted, shortest names first."""
    found = [entry for entry in interfaces if entry.row.value and wanted(last_part(entry.name))]
    return sorted(found, key=lambda entry: (len(entry.name), entry.name))


def last_part(name: str) -> str:
    """Return the last part of a parameter's name."""
    return name.replace("/", ".").rsplit(".", 1)[-1].lstrip("~")


def number_of(interface: Interface) -> float | None:
    """Return the default of a parameter when it is a number."""
    default = interface.default
    return float(default) if isinstance(default, int | float) and not isinstance(default, bool) else None


def is_watchdog(name: str) -> bool:
    """Tell of the name of a parameter whether it says after how long without commands a module stops."""
    return _WATCHDOG.search(name) is not None
