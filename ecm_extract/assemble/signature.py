"""Signature: what a module consumes and produces, in which frame, how long a call may take."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ecm_checker.contract import Interface, Signature, Value
from ecm_checker.hub.roles import Role, roles

from ecm_extract.assemble.definitions import Definitions
from ecm_extract.assemble.evidence import (
    inferred,
    is_watchdog,
    last_part,
    last_told,
    number_of,
    of_interfaces,
    parameters_where,
)
from ecm_extract.link.linker import LinkedModule

_FRAME = re.compile(r"(?:^|_)frame(?:_id|_name)?$")
_OWN_FRAME = ("frame_id", "global_frame", "world_frame", "base_frame_id", "base_frame", "robot_base_frame")
_TIMEOUT = re.compile(r"(?:^|_)timeout(?:_ms|_s|_sec|_seconds)?$")


def signature_of(entry: LinkedModule, definitions: Definitions) -> Signature:
    """Return the signature section of a module."""
    interfaces = entry.interfaces
    return Signature(
        interfaces=interfaces,
        input_schema=_schema(interfaces, {role: row.takes for role, row in roles().items()}, definitions),
        output_schema=_schema(interfaces, {role: row.gives for role, row in roles().items()}, definitions),
        coordinate_frame=_stamped(entry) if entry.stamps else _frame(interfaces),
        timeout_ms=_timeout(interfaces),
        invocation_mode=_mode(interfaces),
    )


def _schema(interfaces: Sequence[Interface], sections: Mapping[Role, str], definitions: Definitions) -> Value | None:
    """`{endpoint: {type, units}}`; for services and actions the type of the section that goes in this direction."""
    found = [entry for entry in interfaces if sections[entry.role] and entry.type is not None]
    return of_interfaces({entry.name: _described(entry, sections[entry.role], definitions) for entry in found}, found)


def _described(entry: Interface, section: str, definitions: Definitions) -> dict[str, Any]:
    described: dict[str, Any] = {"type": entry.type if section == "message" else f"{entry.type}#{section}"}
    units = definitions.units(entry.type or "", section)
    if units:
        described["units"] = units
    if entry.frame:
        described["frame"] = entry.frame
    return described


def _stamped(entry: LinkedModule) -> Value | None:
    """The frame that the module writes into its messages, when it is one only."""
    frames = {stamp.frame for stamp in entry.stamps}
    if len(frames) != 1:
        return None
    surest = max((stamp.confidence for stamp in entry.stamps), key=("literal", "folded", "default", "one_of").index)
    return inferred(frames.pop(), (stamp.evidence for stamp in entry.stamps), surest)


def _frame(interfaces: Iterable[Interface]) -> Value | None:
    """The frame that the parameters of a module name; several are told apart by their parameter."""
    named = [
        entry
        for entry in parameters_where(interfaces, lambda name: _FRAME.search(name) is not None)
        if isinstance(entry.default, str) and entry.default
    ]
    frames = {entry.name: str(entry.default) for entry in named}
    if len(set(frames.values())) == 1:
        return inferred(next(iter(frames.values())), (entry.evidence[0] for entry in named), "default")
    for wanted in _OWN_FRAME:
        own = next((entry for entry in named if last_part(entry.name) == wanted), None)
        if own is not None:
            return inferred(str(own.default), own.evidence[:1], "default")
    return inferred(frames, (entry.evidence[0] for entry in named), "default")


def _is_timeout(name: str) -> bool:
    return _TIMEOUT.search(name) is not None and not is_watchdog(name)


def _timeout(interfaces: Sequence[Interface]) -> Value | None:
    """The longest default of a timeout parameter of a module that is called or calls; seconds unless its name tells.

    What stops a module when commands cease is no time of a call.
    """
    named = [
        (entry, number)
        for entry in parameters_where(interfaces, _is_timeout)
        if (number := number_of(entry)) is not None and number > 0
    ]
    if not named or not any(entry.row.serves or entry.row.calls for entry in interfaces):
        return None
    values = [number if _in_milliseconds(entry) else number * 1000 for entry, number in named]
    return inferred(max(values), (entry.evidence[0] for entry, _ in named), "default")


def _in_milliseconds(entry: Interface) -> bool:
    """Whole numbers are milliseconds in most ROS 2 parameters (`default_server_timeout: 20`)."""
    return last_part(entry.name).endswith("_ms") or entry.type in {"integer", "int"}


def _mode(interfaces: Sequence[Interface]) -> Value | None:
    return last_told(interfaces, lambda row: row.timing)
