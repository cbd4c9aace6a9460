"""Public programs that do something to a system, by the names under which launches start them: the table of them."""

from __future__ import annotations

from functools import cache

import msgspec

from ecm_extract.shipped import shipped_as


class Bridge(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Bridges between ROS and gz."""

    executables: frozenset[str]


class Manager(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Controller managers: programs, part of the library of a plugin that holds one, the simulator of ROS 1."""

    executables: frozenset[str]
    library: str
    simulator: str


class Simulator(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Packages that start a simulator, and its commands."""

    packages: frozenset[str]
    commands: frozenset[str]


class Spawner(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Programs that load controllers, and the words of their command lines.

    Attributes:
        executables: by name. nodes: `package/executable` of those that call themselves after what they load.
        with_value: options that take a word. inactive: those that load without starting. verbs: what is no controller.
    """

    executables: frozenset[str]
    nodes: frozenset[str]
    with_value: frozenset[str]
    inactive: frozenset[str]
    verbs: frozenset[str]


class PluginList(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Parameters that keep plugins out of a program by name, and that let them in again."""

    refused: frozenset[str]
    allowed: frozenset[str]


class Elsewhere(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Names, and beginnings of parameters, that libraries use for a node beside its own source."""

    names: frozenset[str]
    parameters: tuple[str, ...]


class Programs(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The table."""

    bridge: Bridge
    manager: Manager
    simulator: Simulator
    spawner: Spawner
    plugin_list: tuple[PluginList, ...]
    elsewhere: Elsewhere


@cache
def programs() -> Programs:
    """Return the table that ships with the package."""
    return shipped_as("system/programs.toml", Programs)
