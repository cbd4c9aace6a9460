"""What happens on the wire when an interface changes, nested types included."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_parsers.interface_facts import Definition, Field
from ecm_parsers.interface_hash import md5, rihs01

from ecm_extract.diff.model import Pair
from ecm_extract.entities.side import Side

MAX_DEPTH = 30


def ros1_sums(name: str, old: Side, new: Side, new_name: str) -> tuple[str | None, str | None]:
    """Return the ROS 1 sums of an interface before and after; None where a type is not in the tree."""
    before = md5(name, old.interfaces[name], _resolver(old.interfaces)).value
    after = md5(new_name, new.interfaces[new_name], _resolver(new.interfaces)).value
    return before, after


def ros2_hashes(name: str, old: Side, new: Side, new_name: str) -> tuple[str | None, str | None]:
    """Return the ROS 2 type hashes of an interface before and after."""
    before = rihs01(name, old.interfaces[name], _resolver(old.interfaces)).value
    after = rihs01(new_name, new.interfaces[new_name], _resolver(new.interfaces)).value
    return before, after


def wire_note(name: str, old: Side, new: Side, new_name: str) -> str:
    """Say what a connection and a bag do with a changed interface."""
    if name not in old.interfaces or new_name not in new.interfaces:
        return ""
    note = "ROS 2: the type hash changes, old and new sides must both be rebuilt, bags need migration"
    if _ros(new, new_name) != 1:
        return note
    before, after = ros1_sums(name, old, new, new_name)
    if before is None or after is None:
        return "ROS 1: the layout changes; rebuild both sides, bags need a migration rule"
    if before == after:
        return "ROS 1: the MD5 sum does NOT change, so both sides connect and read each other's bytes wrongly"
    return f"ROS 1: MD5 {before[:8]} became {after[:8]}, connections are refused, bags need a migration rule"


def _ros(side: Side, name: str) -> int | None:
    info = side.packages.get(name.partition("/")[0])
    return info.ros if info is not None else None


def nested_changes(pairs: list[Pair], old: Side, new: Side) -> Iterator[tuple[Pair, str]]:
    """Yield interfaces whose own text is the same and whose layout changes, with the nested field that changed.

    Pairs of other kinds, and of messages whose own fields changed, are passed over.
    """
    changed = _changed_types(old, new)
    for pair in pairs:
        if pair.old is None or pair.new is None or pair.old.kind != "message" or pair.old.name in changed:
            continue
        path = _path_to(pair.old.name, old.interfaces, changed, 0)
        if path is not None:
            yield pair, path


def _changed_types(old: Side, new: Side) -> set[str]:
    """Interfaces whose own fields differ, or that are gone."""
    return {
        name
        for name, definition in old.interfaces.items()
        if name not in new.interfaces or _layout(definition) != _layout(new.interfaces[name])
    }


def _layout(definition: Definition) -> tuple[tuple[tuple[str, str], ...], ...]:
    return tuple(tuple((field.type, field.name) for field in section.fields) for section in definition.sections)


def _path_to(name: str, known: Mapping[str, Definition], changed: set[str], depth: int) -> str | None:
    """Return `field.field: Type` for the first nested field whose type changed."""
    definition = known.get(name)
    if definition is None or depth > MAX_DEPTH:
        return None
    package = name.partition("/")[0]
    for section in definition.sections:
        for field in section.fields:
            full = _full(field, package)
            if full in changed:
                return f"{field.name} ({full})"
            deeper = _path_to(full, known, changed, depth + 1)
            if deeper is not None:
                return f"{field.name}.{deeper}"
    return None


def _full(field: Field, package: str) -> str:
    return f"{field.package or package}/msg/{field.base}"


class _Resolver:
    """Definitions of the tree, then of the bundled distributions."""

    def __init__(self, known: Mapping[str, Definition]) -> None:
        self._known = known

    def __call__(self, full: str) -> Definition | None:
        return self._known.get(full)


def _resolver(known: Mapping[str, Definition]) -> _Resolver:
    return _Resolver(known)
