"""Widely used public nodes, known by a table when their source is not in the tree."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib import resources
from typing import NamedTuple

import msgspec

from ecm_extract.system.model import Instance


class PublicEndpoint(NamedTuple):
    """One row: role, name for any node, type."""

    role: str
    name: str
    type: str


class PublicTable(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Names and rows by `package/executable` (with `#1` or `#2` for one ROS version), rows by type of a controller."""

    name: dict[str, str]
    node: dict[str, tuple[PublicEndpoint, ...]]
    controller: dict[str, tuple[PublicEndpoint, ...]]


@cache
def public_table() -> PublicTable:
    """Return the table that ships with the package."""
    text = (resources.files("ecm_extract.system") / "public_nodes.toml").read_text("utf-8")
    return msgspec.convert(tomllib.loads(text), PublicTable)


def default_name(instance: Instance) -> str:
    """Return what a program calls its node when the launch does not: by the table, else like its executable."""
    known = public_table().name.get(f"{instance.package}/{instance.executable}")
    return known or instance.executable.removesuffix(".py") or instance.plugin.rsplit("::", 1)[-1] or "node"


def public_endpoints(instance: Instance) -> Sequence[PublicEndpoint]:
    """Return the endpoints of an instance whose source is not in the tree; empty when the table does not know it."""
    if instance.kind == "controller":
        return _rows(public_table().controller, instance.plugin, instance.ros)
    name = instance.plugin or f"{instance.package}/{instance.executable.removesuffix('.py')}"
    return _rows(public_table().node, name, instance.ros)


def _rows(table: Mapping[str, tuple[PublicEndpoint, ...]], name: str, ros: int) -> Sequence[PublicEndpoint]:
    return table.get(f"{name}#{ros}") or table.get(name) or ()
