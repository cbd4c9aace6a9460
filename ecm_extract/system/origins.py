"""What tells the endpoints of a node: its source, a table, or nothing."""

from __future__ import annotations

from typing import Literal, TypeAlias

from ecm_extract.system.model import Instance
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.public_nodes import public_table

Origin: TypeAlias = Literal["source", "table", "silent", "unknown"]


def origin_of(node: SystemNode) -> Origin:
    """Return where the endpoints of a node are known from; nobody connects to those of a silent one by name."""
    if node.modules or node.instance.kind == "simulated":
        return "source"
    if code_of(node.instance) in public_table().silent:
        return "silent"
    return "table" if node.endpoints else "unknown"


def code_of(instance: Instance) -> str:
    """Return the class or the program that an instance runs."""
    return instance.plugin or f"{instance.package}/{instance.executable}".strip("/")
