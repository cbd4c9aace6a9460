"""What the nodes of a system ask of each other, matched by the engine: met, dangling, incompatible or unknown.

Within one launch names are whole, so that they compare as they stand. What is asked for and not there is missing only
where the endpoints of every node are known; else somebody whose source is elsewhere may offer it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.condition import Condition
from ecm_checker.hub.kinds import kinds, uses
from ecm_checker.hub.package import Package, provided
from ecm_checker.hub.provision import HOLE, Key, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.roles import roles
from ecm_checker.match.alternatives import alternatives
from ecm_checker.match.engine import Match
from ecm_checker.match.exclusive import contended
from ecm_checker.match.packages import Packages

from ecm_extract.description.model import Hardware
from ecm_extract.system.controllers import Controller
from ecm_extract.system.holes import with_mark
from ecm_extract.system.model import Instance, Place
from ecm_extract.system.node_model import Endpoint, SystemNode
from ecm_extract.system.origins import origin_of
from ecm_extract.system.started import STARTED
from ecm_extract.system.system import System

CLAIM: Final = "claims"


class Connections:
    """What the nodes of a system offer each other, and what they ask for."""

    def __init__(self, system: System) -> None:
        self._packages = Packages([_package(system)])

    @cached_property
    def matches(self) -> Sequence[Match]:
        """What became of each subscription, client and claim, in the order of the nodes."""
        packages = self._packages
        found = [packages.match(each, one) for one in packages.consumers for each in one.requirements]
        return contended(alternatives(found))

    def offered(self, use: str) -> Iterator[Provision]:
        """Yield what a use may mean, whatever its name."""
        row = uses()[use]
        found = (each for kind in row.of for each in self._packages.provisions.of_kind(kind))
        return (each for each in found if row.facet in {"", each.facet})


def connections(system: System) -> Sequence[Match]:
    """Return what became of each subscription, client and claim, in the order of the nodes."""
    return Connections(system).matches


def _package(system: System) -> Package:
    return Package(
        name=STARTED,
        version=None,
        path="",
        ros=None,
        provides=tuple(provided(each) for each in _by_key(_offers(system))),
        requires=tuple(_wants(system)),
        open=tuple(_open_kinds(system)),
    )


def _open_kinds(system: System) -> Iterator[str]:
    """Kinds of which something that is not known may offer any name."""
    if not _is_known(system):
        yield from (name for name, kind in kinds().items() if kind.world == "graph")
    elif not any(robot.hardware for robot in system.robots):
        yield uses()[CLAIM].of[0]


def _is_known(system: System) -> bool:
    """Whether everything that runs, and every name that it has, is known."""
    is_whole = system.launched.is_complete and system.launched.is_closed and not system.unknown
    return is_whole and all(origin_of(node) != "unknown" for node in system.nodes)


def _by_key(offers: Iterable[Provision]) -> Iterator[Provision]:
    """What one node offers under one name, with all types that it may have there."""
    found: dict[Key, Provision] = {}
    for each in offers:
        first = found.setdefault(each.key, each)
        if first.type is not None and each.type not in {None, first.type, *first.others}:
            found[each.key] = msgspec.structs.replace(first, others=(*first.others, each.type or ""))
    return iter(found.values())


def _offers(system: System) -> Iterator[Provision]:
    for node in system.nodes:
        for entry in node.endpoints:
            row = roles()[entry.role]
            if row.provides and row.channel is not None:
                yield _offer(row.provides, row.facet, entry, node)
    for robot in system.robots:
        for hardware in robot.hardware:
            yield from _interfaces(hardware, robot.name)


def _interfaces(hardware: Hardware, robot: str) -> Iterator[Provision]:
    for part in hardware.parts:
        for name in part.interfaces():
            yield Provision(
                kind=uses()[CLAIM].of[0],
                package=STARTED,
                owner=robot,
                name=_name(name),
                path=part.where.path,
                line=part.where.line,
                when=_when(hardware.conditional),
            )


def _offer(kind: str, facet: str, entry: Endpoint, node: SystemNode) -> Provision:
    return Provision(
        kind=kind,
        facet=facet,
        package=STARTED,
        owner=node.name,
        name=_name(entry.name),
        type=entry.type,
        qos=entry.qos,
        ros=node.instance.ros,
        path=entry.place.path,
        line=entry.place.line,
        when=_when(node.instance.conditional),
    )


def _wants(system: System) -> Iterator[Requirement]:
    for node in system.nodes:
        for entry in node.endpoints:
            use = roles()[entry.role].joins
            if use:
                yield _want(use, entry, node)
    chained = tuple(f"{each.name}/" for each in system.controllers)
    for controller in system.controllers:
        if controller.active:
            yield from _claims(controller, chained)


def _want(use: str, entry: Endpoint, node: SystemNode) -> Requirement:
    return Requirement(
        use=use,
        kind=uses()[use].of[0],
        package=STARTED,
        owner="",
        name=_name(entry.name),
        type=entry.type,
        qos=entry.qos,
        certainty="likely" if entry.known else "unknown",
        conditions=_words(node.instance),
        when=_when(node.instance.conditional),
        by=node.name,
        said=entry.name,
        ros=node.instance.ros,
        evidence=_lines(entry.place, node.instance.place),
    )


def _claims(controller: Controller, chained: tuple[str, ...]) -> Iterator[Requirement]:
    """What a controller claims; reference interfaces that other controllers export (`chained`) nobody tells."""
    for name in controller.claims or ():
        yield Requirement(
            use=CLAIM,
            kind=uses()[CLAIM].of[0],
            package=STARTED,
            owner="",
            name=_name(name),
            type=None,
            certainty="unknown" if "{" in name or name.startswith(chained) else "likely",
            conditions=(controller.conditional,) if controller.conditional else (),
            when=_when(controller.conditional),
            said=name,
            by=f"{controller.namespace.rstrip('/')}/{controller.name}",
            ros=controller.ros,
            evidence=_lines(controller.place),
        )


def _name(text: str) -> str:
    return with_mark(text, HOLE)


def _words(instance: Instance) -> tuple[str, ...]:
    return (instance.conditional,) if instance.conditional else ()


def _when(conditional: str) -> tuple[Condition, ...]:
    """What the launch does not decide stands as it was evaluated."""
    return (Condition("expression", conditional),) if conditional else ()


def _lines(*places: Place) -> tuple[Evidence, ...]:
    return tuple(Evidence(place.path, place.line) for place in dict.fromkeys(places))
