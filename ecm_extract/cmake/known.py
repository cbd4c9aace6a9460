"""What is set before a file asks for it: by the system, by packages that are found, by modules of CMake."""

from __future__ import annotations

from functools import cache
from typing import Literal

import msgspec

from ecm_extract.cmake.values import PREFIX, Value, unknown
from ecm_extract.shipped import shipped, shipped_as


class _Names(msgspec.Struct, frozen=True):
    names: frozenset[str]


class Known(msgspec.Struct, frozen=True):
    """The tables of known.toml."""

    system: dict[str, str]
    absent: _Names
    settings: _Names
    tests: _Names
    packages: dict[str, dict[str, str]]
    modules: dict[str, dict[str, str]]
    openers: _Names
    brought: dict[str, tuple[str, ...]]
    makers: _Names
    quiet: _Names
    install_types: dict[str, str]
    install_artefacts: dict[str, str]
    from_manifest: dict[str, dict[str, Literal["name", "version"]]]


@cache
def known() -> Known:
    """Return the tables."""
    return shipped_as("cmake/known.toml", Known)


@cache
def commands() -> frozenset[str]:
    """Return the commands of CMake that make no target."""
    return frozenset(shipped("cmake/commands.toml")["commands"])


def at_start() -> dict[str, Value]:
    """Return the variables before the first command: those of a Linux with tests on, unless they are turned off."""
    found = {name: Value((text.format(prefix=PREFIX),)) for name, text in known().system.items()}
    found |= dict.fromkeys(known().absent.names, Value((None,)))
    found |= {name: Value((None, unknown(name))) for name in known().settings.names}
    return found | dict.fromkeys(known().tests.names, Value(("ON", "OFF")))


_TRUE = frozenset({"1", "ON", "YES", "TRUE", "Y"})


def is_true(text: str) -> bool:
    """Tell whether a text is one of the constants that mean true."""
    return text.upper() in _TRUE
