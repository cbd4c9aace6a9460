"""Widely used public nodes, known by a table when their source is not in the tree."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import Any, NamedTuple

import msgspec
from ecm_checker.hub.roles import Role

from ecm_extract.shipped import shipped_as
from ecm_extract.system.model import Instance
from ecm_extract.system.programs import programs
from ecm_extract.system.spawners import spawned


class PublicEndpoint(NamedTuple):
    """One row: role, name for any node, type, and the setting `parameter=value` or `parameter!=value` that it needs."""

    role: Role
    name: str
    type: str
    when: str = ""


_SEVERAL = re.compile(r"\$\{([\w.]+#|[\w.]+\*[\w.]+)=\}")


def unset(_: str) -> Any:
    """Return None: no parameter is set."""
    return None


class PublicTable(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Names and rows by `package/executable` (with `#1` or `#2` for one ROS version), rows by type of a controller.

    `silent` are programs whose endpoints nobody connects to by name, `managed` is what every managed node has below its
    name.
    """

    silent: frozenset[str]
    managed: tuple[PublicEndpoint, ...]
    name: dict[str, str]
    node: dict[str, tuple[PublicEndpoint, ...]]
    controller: dict[str, tuple[PublicEndpoint, ...]]


@cache
def public_table() -> PublicTable:
    """Return the table that ships with the package."""
    return shipped_as("system/public_nodes.toml", PublicTable)


def default_name(instance: Instance) -> str:
    """Return what a program calls its node when the launch does not: by the table, else like its executable."""
    if f"{instance.package}/{instance.executable}" in programs().spawner.nodes:
        return "_".join(["spawner", *(entry.name for entry in list(spawned([instance]))[:1])])
    known = public_table().name.get(f"{instance.package}/{instance.executable}")
    return known or instance.executable.removesuffix(".py") or instance.plugin.rsplit("::", 1)[-1] or "node"


def public_endpoints(instance: Instance, parameter: Callable[[str], Any] = unset) -> Sequence[PublicEndpoint]:
    """Return the endpoints of an instance whose source is not in the tree; empty when the table does not know it.

    Args:
        instance: of the launch.
        parameter: gives the value of a parameter, None when it is not set; the values of all for a name with `*`.
    """
    if instance.kind == "controller":
        rows = _rows(public_table().controller, instance.plugin, instance.ros)
    else:
        name = instance.plugin or f"{instance.package}/{instance.executable.removesuffix('.py')}"
        rows = _rows(public_table().node, name, instance.ros)
    return [made for row in rows if _holds(row.when, parameter) for made in _numbered(row, parameter)]


def _holds(when: str, parameter: Callable[[str], Any]) -> bool:
    name, _, value = when.partition("=")
    same = str(parameter(name.removesuffix("!"))).lower() == value
    return not when or same is not name.endswith("!")


def _numbered(row: PublicEndpoint, parameter: Callable[[str], Any]) -> Iterator[PublicEndpoint]:
    """Yield a row once; one of `${name#=}` or `${a.*.b=}` once for each of these parameters that is set."""
    match = _SEVERAL.fullmatch(row.name)
    if match is None:
        yield row
        return
    names = [match[1].replace("#", str(digit)) for digit in range(10)] if "#" in match[1] else [match[1]]
    for name in names:
        given = parameter(name)
        yield from (row._replace(name=each) for each in (given if isinstance(given, list) else [given]) if each)


def _rows(table: Mapping[str, tuple[PublicEndpoint, ...]], name: str, ros: int) -> Sequence[PublicEndpoint]:
    return table.get(f"{name}#{ros}") or table.get(name) or ()
