"""Names below a node that a launch writes in full, as `/arm/state`, matched with the nodes that are started."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.package import Package, folders_of, provided
from ecm_checker.hub.provision import ABOVE, Key, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.engine import Match
from ecm_checker.match.packages import Packages

from ecm_extract.system.model import Instance, Place, Remapping
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.started import STARTED

_USE: Final = "reaches"
_MANAGER: Final = 2
"""Of `load pkg/Class manager`, the arguments of a nodelet."""


class _Told(msgspec.Struct, frozen=True):
    """A name, the line that tells it, and the remap that does so."""

    name: str
    place: Place
    remap: Remapping | None = None


class Reached(msgspec.Struct, frozen=True):
    """An absolute name that a node is told to use.

    Attributes:
        node: that is told. name: in full. place: of the line that tells it.
        remap: that does so; None where the name is that of the manager that loads it.
        match: `met` where its first part is a node, or the namespace of one; else `dangling`.
    """

    node: SystemNode
    name: str
    place: Place
    remap: Remapping | None
    match: Match

    @property
    def nodes(self) -> tuple[Provision, ...]:
        """The nodes of that name."""
        return tuple(each for each in self.match.found if each.facet != ABOVE)


def reached(nodes: Sequence[SystemNode], started: Iterable[Instance]) -> Iterator[Reached]:
    """Yield the absolute names that nodes are told to use.

    Args:
        nodes: that are told.
        started: what may be meant.
    """
    rows: dict[Key, Provision] = {}
    for row in (row for instance in started for row in _rows(instance)):
        rows[row.key] = row  # the last one of a name counts
    offered = tuple(provided(each) for each in rows.values())
    packages = Packages([Package(name=STARTED, version=None, path="", ros=None, provides=offered)])
    for node in nodes:
        for told in _absolute(node.instance):
            match = packages.match(_required(told, node), packages.consumers[0])
            yield Reached(node, told.name, told.place, told.remap, match)


def _rows(instance: Instance) -> Iterator[Provision]:
    """A node, and the namespaces that it is in."""
    name = instance.full_name or ""
    if name:
        yield _row(instance, name, "")
        yield from (_row(instance, above, ABOVE) for above in folders_of(name))


def _row(instance: Instance, name: str, facet: str) -> Provision:
    place = instance.place
    return Provision(kind="node", package=STARTED, owner="", name=name, facet=facet, path=place.path, line=place.line)


def _absolute(instance: Instance) -> Iterator[_Told]:
    for remap in instance.remaps:
        if remap.target.startswith("/") and remap.target.count("/") > 1:
            yield _Told(remap.target, remap.place, remap)
    words = [word.text for word in instance.arguments]
    manager = words[_MANAGER] if instance.executable == "nodelet" and words[:1] == ["load"] and words[_MANAGER:] else ""
    if manager.startswith("/"):
        yield _Told(manager, instance.place)


def _required(told: _Told, node: SystemNode) -> Requirement:
    return Requirement(
        use=_USE,
        kind=uses()[_USE].of[0],
        package=STARTED,
        owner="",
        name=f"/{told.name.split('/')[1]}",
        type=None,
        certainty="likely",
        conditions=(),
        by=node.name,
        target=told.name,
        ros=node.instance.ros,
        evidence=(Evidence(told.place.path, told.place.line),),
    )
