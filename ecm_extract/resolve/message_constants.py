"""Constants that `.msg`, `.srv` and `.action` files declare, by the names that generated code gives them.

Sources: genmsg, rosidl_parser (how values are read), rosidl_generator_cpp, rosidl_generator_py, gencpp, genpy (names).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath
from typing import Final

from ecm_parsers.interface_facts import Constant

from ecm_extract.read.facts import PackageFacts

_TEXTS: Final = frozenset({"string", "wstring"})
_FLOATS: Final = frozenset({"float32", "float64"})
_TRUE, _FALSE = frozenset({"true", "1"}), frozenset({"false", "0"})


def message_constants(package: PackageFacts) -> Mapping[str, str | float]:
    """Return the constants of a package by what stands behind its name: `Lamp.RED`, `SetMode.Request.SLOW`."""
    found: dict[str, str | float] = {}
    for path, definition in package.interfaces.items():
        for section in definition.sections:
            for constant in section.constants:
                value = _value(constant, package.ros)
                if value is not None:
                    owners = _owners(PurePosixPath(path).stem, section.name)
                    found |= {f"{owner}.{constant.name}": value for owner in owners}
    return found


def _owners(name: str, section: str) -> Iterator[str]:
    """The classes that have the constants of a section: ROS 2 nests them, ROS 1 writes the names together."""
    if section == "message":
        yield name
        return
    part = section.capitalize()
    yield from (f"{name}.{part}", f"{name}_{part}", f"{name}{part}")


def _value(constant: Constant, ros: int | None) -> str | float | None:
    """The value of a constant; None of one that is not written as its type has it."""
    if constant.type in _TEXTS:
        return constant.text if ros == 1 else constant.value
    if constant.type == "bool":
        lower = constant.value.lower()
        return True if lower in _TRUE else False if lower in _FALSE else None
    return _number(constant)


def _number(constant: Constant) -> float | None:
    try:
        return float(constant.value) if constant.type in _FLOATS else int(constant.value, 0)
    except ValueError:
        return None
