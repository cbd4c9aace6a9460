"""What a launch starts as provisions and requirements: the nodes under their names in the graph, and whom they name.

The rows of launch files hold what stands there; these hold what it comes to when the files are evaluated together.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.package import Package, provided
from ecm_checker.hub.provision import LAUNCHED, Provision
from ecm_checker.hub.requirement import Requirement

from ecm_extract.system.model import Instance, Place
from ecm_extract.system.system import System

STARTED: Final = "launch"
"""Name under which what launches start together stands."""


def started_package(system: System) -> Package:
    """Return what a launch starts as the document of a package."""
    nodes = tuple(provided(each) for each in started_nodes(system))
    return Package(
        name=STARTED, version=None, path="", ros=None, provides=nodes, requires=tuple(started_requirements(system))
    )


def started_nodes(system: System) -> Iterator[Provision]:
    """Yield each node that is started under a known name; one that no namespace holds is relative, as it is written."""
    for instance in _instances(system):
        name = instance.full_name or ""
        yield Provision(
            kind="node",
            facet=LAUNCHED,
            package=instance.package,
            owner=instance.place.path.rpartition("/")[2],
            name=name.lstrip("/") if _is_relative(instance) else name,
            bases=tuple(part for part in (instance.package, instance.executable, instance.plugin) if part),
            ros=instance.ros,
            path=instance.place.path,
            line=instance.place.line,
        )


def started_requirements(system: System) -> Iterator[Requirement]:
    """Yield the names that the nodes are told to use, and the containers that they are loaded into."""
    for instance in _instances(system):
        by = f"node {instance.full_name}"
        for remap in instance.remaps:
            yield _required("remaps", remap.source, remap.target, instance, remap.place, by)
        target = instance.container or ""
        if target.rpartition("/")[2]:
            yield _required("loads_into", target.rpartition("/")[2], target, instance, instance.place, by)


def _instances(system: System) -> Iterator[Instance]:
    """Those that are started for sure; controllers and components of ROS 2 are named by what holds them."""
    for node in system.nodes:
        name = node.instance.full_name
        if name and "{" not in name and not node.instance.conditional:
            yield node.instance


def _is_relative(instance: Instance) -> bool:
    return instance.namespace == "/" and not (instance.name or "").startswith("/")


def _required(use: str, name: str, target: str, instance: Instance, place: Place, by: str) -> Requirement:
    return Requirement(
        use=use,
        kind=uses()[use].of[0],
        package=instance.package or None if uses()[use].leads else None,
        owner="",
        name=name,
        type=None,
        certainty="likely",
        conditions=(),
        by=by,
        evidence=(Evidence(place.path, place.line),),
        target=target,
        ros=instance.ros,
    )
