"""What happens on the wire when an interface changes, nested types included."""

from __future__ import annotations

from collections import deque
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass

from ecm_parsers.interface_facts import Definition, Field
from ecm_parsers.interface_hash import md5

from ecm_extract.diff.bytes_of import SameBytes, own_difference
from ecm_extract.diff.model import Pair
from ecm_extract.entities.side import Side

MAX_SHOWN = 20
"""Fields of a way that are written out."""


def ros1_sums(name: str, old: Side, new: Side, new_name: str) -> tuple[str | None, str | None]:
    """Return the ROS 1 sums of an interface before and after; None where a type is not in the tree."""
    before = md5(name, old.interfaces[name], _resolver(old.interfaces)).value
    after = md5(new_name, new.interfaces[new_name], _resolver(new.interfaces)).value
    return before, after


def wire_note(name: str, old: Side, new: Side, new_name: str) -> str:
    """Say what a connection and a bag do with a changed interface."""
    if name not in old.interfaces or new_name not in new.interfaces:
        return ""
    if ros_of(new, new_name) != 1:
        return "ROS 2: the type hash changes, old and new sides must both be rebuilt, bags need migration"
    if SameBytes(old.interfaces, new.interfaces)(name, new_name):
        return "ROS 1: its bytes and its MD5 sum stay the same; what has another name must be followed in code"
    before, after = ros1_sums(name, old, new, new_name)
    if before is None or after is None:
        return "ROS 1: the definition changes; rebuild both sides, bags need a migration rule"
    if before == after:
        return "ROS 1: the MD5 sum does NOT change, so both sides connect and read each other's bytes wrongly"
    return f"ROS 1: MD5 {before[:8]} became {after[:8]}, connections are refused, bags need a migration rule"


def ros_of(side: Side, name: str) -> int | None:
    """The ROS of the package of an interface; None where that is not known."""
    info = side.packages.get(name.partition("/")[0])
    return info.ros if info is not None else None


def nested_changes(pairs: list[Pair], old: Side, new: Side) -> Iterator[tuple[Pair, str]]:
    """Yield interfaces whose own text is the same and that hold one that changed, with the field that does.

    Pairs of other kinds, and of messages whose own fields changed, are passed over.
    """
    same = SameBytes(old.interfaces, new.interfaces)
    differing = {name for name in old.interfaces if name not in new.interfaces or _difference(name, old, new)}
    alike = {name for name in differing if name in new.interfaces and _is_alike(name, old, new, same)}
    known = {name: definition for name, definition in old.interfaces.items() if name not in alike}
    ways = ways_to(differing - alike, known)
    for pair in pairs:
        if pair.old is None or pair.new is None or not pair.old.row.generated:
            continue
        if ways.get(pair.old.name) is not None:
            yield pair, way_text(pair.old.name, ways)


def own_changes(pairs: Iterable[Pair], told: Container[str], old: Side, new: Side) -> Iterator[tuple[Pair, str]]:
    """Yield interfaces whose own text changed what two sides compare though none of their parts did, and how.

    Args:
        pairs: of all kinds.
        told: interfaces of which the change of a part is told.
        old: the side before.
        new: the side after.
    """
    same = SameBytes(old.interfaces, new.interfaces)
    for pair in pairs:
        if pair.old is None or pair.new is None or not pair.old.row.generated or pair.old.name in told:
            continue
        how = _difference(pair.old.name, old, new) if pair.old.name == pair.new.name else ""
        if how and not _is_alike(pair.old.name, old, new, same):
            yield pair, how


def _difference(name: str, old: Side, new: Side) -> str:
    before, after = old.interfaces.get(name), new.interfaces.get(name)
    if before is None or after is None:
        return ""
    return own_difference(before, after, name.partition("/")[0], _is_ros1(name, old, new))


def _is_alike(name: str, old: Side, new: Side, same: SameBytes) -> bool:
    """Whether two sides talk as they did: a nested type has another name, which ROS 1 does not compare."""
    return _is_ros1(name, old, new) and same(name, name)


def _is_ros1(name: str, *sides: Side) -> bool:
    return all(ros_of(side, name) == 1 for side in sides)


@dataclass(frozen=True, slots=True)
class Step:
    """The field through which an interface holds another one, nearer to a changed type."""

    field: str
    holds: str


def ways_to(changed: set[str], known: Mapping[str, Definition]) -> dict[str, Step | None]:
    """Return the next step of each interface to a changed type by the shortest way, None where it is one itself.

    Each interface and field is looked at once, however many ways lead through it.
    """
    holders = _holders(known)
    ways: dict[str, Step | None] = dict.fromkeys(sorted(changed))
    pending = deque(ways)
    while pending:
        held = pending.popleft()
        for name, field in holders.get(held, {}).items():
            if name not in ways:
                ways[name] = Step(field, held)
                pending.append(name)
    return ways


def _holders(known: Mapping[str, Definition]) -> dict[str, dict[str, str]]:
    """Return for each type the interfaces that hold it, with the first field that does."""
    found: dict[str, dict[str, str]] = {}
    for name, definition in known.items():
        package = name.partition("/")[0]
        for field in (field for section in definition.sections for field in section.fields):
            found.setdefault(_full(field, package), {}).setdefault(name, field.name)
    return found


def way_text(name: str, ways: Mapping[str, Step | None]) -> str:
    """Return `field.field (Type)`; of a long way the fields in the middle are left out."""
    fields: list[str] = []
    while (step := ways[name]) is not None:
        fields.append(step.field)
        name = step.holds
    if len(fields) > MAX_SHOWN:
        fields = [*fields[: MAX_SHOWN // 2], "...", *fields[-MAX_SHOWN // 2 :]]
    return f"{'.'.join(fields)} ({name})"


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
