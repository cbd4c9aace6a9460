"""Nodes of the graph with the endpoints and parameters that they have there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ecm_checker.contract import Qos
from ecm_checker.hub.roles import Role, RoleKind, roles
from ecm_checker.hub.running import RunningModule

from ecm_extract.system.model import Instance, Place, Remapping


@dataclass(frozen=True, slots=True)
class Endpoint:
    """One endpoint of a node of the graph.

    Attributes:
        role: as in the contract. name: in the graph. before: without remaps.
        type: `package/msg|srv|action/Name`; None when not known.
        node: full name of the node. remap: that gave it its name.
        parameters: names of the parameters that give a part of it.
        known: False when a part of the name is a pattern.
        place: of the declaring line.
    """

    role: Role
    name: str
    before: str
    type: str | None
    node: str
    remap: Remapping | None
    parameters: tuple[str, ...]
    known: bool
    place: Place
    qos: Qos | None = None

    @property
    def row(self) -> RoleKind:
        """What its role is to others."""
        return roles()[self.role]


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of a node: its value here, and where that was set; `place` is None for the program's default.

    `declared` tells whether the program reads it; None when the program is not in the tree.
    """

    name: str
    value: Any
    place: Place | None
    declared: bool | None


@dataclass(slots=True, eq=False)
class SystemNode:
    """A node of the graph.

    Attributes:
        name: full name. instance: what starts it. modules: its contract and those of its plugins; empty when its
            code is not in the tree.
        guessed: the name is that of its executable, since its code is not in the tree.
    """

    name: str
    instance: Instance
    modules: tuple[RunningModule, ...] = ()
    guessed: bool = False
    endpoints: tuple[Endpoint, ...] = ()
    parameters: tuple[Parameter, ...] = ()

    @property
    def namespace(self) -> str:
        """Namespace of the node."""
        return self.name.rpartition("/")[0] or "/"
