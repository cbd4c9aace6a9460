"""What a launch gives its nodes under their own names, as requirements and provisions: remaps and parameters.

What one action starts in one process gets the same remaps and parameters, so that its nodes own their names together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.package import Package, folders_of, provided
from ecm_checker.hub.provision import ABOVE, Key, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.roles import roles
from ecm_checker.match.engine import Match
from ecm_checker.match.packages import Packages

from ecm_extract.system.model import Place, Remapping
from ecm_extract.system.names import absolute
from ecm_extract.system.node_model import Parameter, SystemNode
from ecm_extract.system.programs import programs
from ecm_extract.system.started import STARTED

_RENAMES: Final = "renames"
_FILLS: Final = "fills"
_CAMERA_INFO: Final = "/camera_info"
_IMAGE: Final = "sensor_msgs/msg/Image"
_Test = Callable[[SystemNode], bool]


class Renamed(msgspec.Struct, frozen=True):
    """A remap that a node is given, and what became of it; `dangling` where its process has no such name for sure."""

    node: SystemNode
    remap: Remapping
    match: Match


class Filled(msgspec.Struct, frozen=True):
    """A parameter that a node is given, and what became of it; `dangling` where nothing in its process reads it."""

    node: SystemNode
    parameter: Parameter
    match: Match


def renamed(nodes: Sequence[SystemNode]) -> Iterator[Renamed]:
    """Yield the remaps of nodes with what they rename."""
    names = (each for node in nodes for each in _names(node))
    packages = _packages([*_processes(nodes, _has_known_names), *names])
    for node in nodes:
        for remap in node.instance.remaps:
            yield Renamed(node, remap, _match(packages, _renames(remap, node)))


def filled(nodes: Sequence[SystemNode]) -> Iterator[Filled]:
    """Yield the parameters that nodes are given with what reads them."""
    read = (_own("parameter", each.name, node) for node in nodes for each in node.parameters if each.declared)
    packages = _packages([*_processes(nodes, _has_known_code), *read])
    for node in nodes:
        for each in node.parameters:
            if each.place is not None:
                yield Filled(node, each, _match(packages, _fills(each, each.place, node)))


def _match(packages: Packages, requirement: Requirement) -> Match:
    return packages.match(requirement, packages.consumers[0])


def _packages(rows: Iterable[Provision]) -> Packages:
    found: dict[Key, Provision] = {}
    for each in rows:  # one name of two nodes is one, and what one leaves open is open
        found[each.key] = each if each.open or each.key not in found else found[each.key]
    package = Package(name=STARTED, version=None, path="", ros=None, provides=tuple(map(provided, found.values())))
    return Packages([package])


def _processes(nodes: Sequence[SystemNode], is_known: _Test) -> Iterator[Provision]:
    """What owns the names: open where one of its nodes may have names that nothing tells."""
    for node in nodes:
        row = _own("node", _process(node), node)
        yield msgspec.structs.replace(row, owner="", open=not is_known(node))


def _process(node: SystemNode) -> str:
    place = node.instance.place
    return f"{place.path}:{place.line}"


def _own(kind: str, name: str, node: SystemNode, facet: str = "") -> Provision:
    place = node.instance.place
    return Provision(
        kind=kind,
        package=STARTED,
        owner=_process(node),
        name=name,
        facet=facet,
        path=place.path,
        line=place.line,
    )


def _names(node: SystemNode) -> Iterator[Provision]:
    """Names of a node before remaps, and those above them: a transport makes several below one."""
    for entry in node.endpoints:
        kind = roles()[entry.role].channel
        if kind is not None and "{" not in entry.before:
            yield _own(kind, entry.before, node)
            yield from (_own(kind, name, node, ABOVE) for name in folders_of(entry.before))


def _has_known_names(node: SystemNode) -> bool:
    return bool(node.modules) and all(entry.known for entry in node.endpoints)


def _has_known_code(node: SystemNode) -> bool:
    return bool(node.modules) and not node.guessed


def _renames(remap: Remapping, node: SystemNode) -> Requirement:
    name = absolute(remap.source, node.namespace, node.name.rpartition("/")[2])
    is_sure = node.endpoints and "{" not in f"{node.name}{remap.source}" and not _is_elsewhere(remap.source, name, node)
    row = _required(_RENAMES, name, remap.place, node, "likely" if is_sure else "unknown")
    return msgspec.structs.replace(row, said=remap.source, target=remap.target)


def _is_elsewhere(source: str, name: str, node: SystemNode) -> bool:
    """Whether a library may make the name; a subscriber of a camera takes the one from beside its image."""
    beside = name.endswith(_CAMERA_INFO) and any(entry.type == _IMAGE for entry in node.endpoints)
    return beside or source.startswith("__") or source in programs().elsewhere.names


def _fills(parameter: Parameter, place: Place, node: SystemNode) -> Requirement:
    """Another parameter may say that it is to be read: its value is the name."""
    is_told = any(entry.value == parameter.name for entry in node.parameters)
    is_sure = not is_told and not parameter.name.startswith(programs().elsewhere.parameters)
    return _required(_FILLS, parameter.name, place, node, "likely" if is_sure else "unknown")


def _required(use: str, name: str, place: Place, node: SystemNode, certainty: Certainty) -> Requirement:
    return Requirement(
        use=use,
        kind=uses()[use].of[0],
        package=STARTED,
        owner=_process(node),
        name=name,
        type=None,
        certainty=certainty,
        conditions=(),
        by=node.name,
        ros=node.instance.ros,
        evidence=(Evidence(place.path, place.line),),
    )
