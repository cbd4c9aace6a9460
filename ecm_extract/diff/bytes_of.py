"""Whether an interface has the bytes and the sum that another one has, and what in its own text tells them apart.

A field is its name, its type and its place: two that changed their places are read as each other. What ROS 1 hashes
holds the constants too, but of a nested type neither its name nor whether it is an array; ROS 2 hashes the names of
nested types and no constants (REP 2016).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from ecm_parsers.interface_facts import PRIMITIVES, ROS1_TIMES, Constant, Definition, Field

MAX_DEPTH: Final = 60
_PLAIN: Final = PRIMITIVES | ROS1_TIMES
Known = Mapping[str, Definition]


def field_text(field: Field, package: str) -> tuple[str, str, str]:
    """The full type, what kind of array it is, and the name: all that both sides must have alike."""
    return full_type(field, package), _shape(field), field.name


def full_type(field: Field, package: str) -> str:
    """`geometry_msgs/msg/Pose`; a primitive as it is written."""
    if field.package is None and field.base in _PLAIN:
        return field.base
    return f"{field.package or package}/msg/{field.base}"


def constant_text(constant: Constant) -> tuple[str, str, str]:
    """What ROS 1 hashes of a constant."""
    return constant.type, constant.name, constant.text


def _shape(field: Field) -> str:
    return f"{field.array} {field.bound} {field.string_bound}"


class SameBytes:
    """Compares interfaces of two sides down to their primitives, as ROS 1 does: names of types do not count.

    Each pair is compared once; where types hold themselves, or lie too deep, nothing is said to be the same.
    """

    def __init__(self, old: Known, new: Known) -> None:
        self._old, self._new = old, new
        self._decided: dict[tuple[str, str], bool] = {}

    def __call__(self, old: str, new: str, depth: int = 0) -> bool:
        """Whether two interfaces have the same fields and constants in one order; unknown ones the same name."""
        before, after = self._old.get(old), self._new.get(new)
        if before is None or after is None:
            return before is after and old == new
        if depth >= MAX_DEPTH:
            return False
        if (old, new) not in self._decided:
            self._decided[old, new] = False
            packages = old.partition("/")[0], new.partition("/")[0]
            self._decided[old, new] = self._is_same(before, after, packages, depth)
        return self._decided[old, new]

    def _is_same(self, old: Definition, new: Definition, packages: tuple[str, str], depth: int) -> bool:
        if old.shape != new.shape:
            return False
        for before, after in zip(old.sections, new.sections, strict=True):
            if list(map(constant_text, before.constants)) != list(map(constant_text, after.constants)):
                return False
            if len(before.fields) != len(after.fields):
                return False
            pairs = zip(before.fields, after.fields, strict=True)
            if not all(self._is_same_field(one, other, packages, depth) for one, other in pairs):
                return False
        return True

    def _is_same_field(self, old: Field, new: Field, packages: tuple[str, str], depth: int) -> bool:
        if (old.name, _shape(old)) != (new.name, _shape(new)):
            return False
        before, after = full_type(old, packages[0]), full_type(new, packages[1])
        if "/" not in before or "/" not in after:
            return before == after
        return self(before, after, depth + 1)


def own_difference(old: Definition, new: Definition, package: str, hashes_constants: bool) -> str:
    """Say how the own text of an interface differs in what both sides must have alike; empty where it does not.

    Args:
        old: the definition before.
        new: the one after.
        package: that has both.
        hashes_constants: whether constants are part of what is compared when two sides connect.
    """
    for before, after in zip(old.sections, new.sections, strict=old.shape == new.shape):
        fields = [[field_text(field, package) for field in side.fields] for side in (before, after)]
        if fields[0] != fields[1]:
            moved = sorted(fields[0]) == sorted(fields[1])
            names = [", ".join(name for _, _, name in side) for side in fields]
            return f"its fields have another order: {names[0]} became {names[1]}" if moved else "its fields changed"
        constants = [[constant_text(constant) for constant in side.constants] for side in (before, after)]
        if hashes_constants and constants[0] != constants[1]:
            moved = sorted(constants[0]) == sorted(constants[1])
            return "its constants have another order" if moved else "its constants changed"
    return ""
