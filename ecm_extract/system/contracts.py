"""Contracts of the nodes of a system: what each offers, asks for and claims under the names that it has there.

A contract of source says what a module could do anywhere; these are what a launch really composes, so that the
checker may take it that they run together.
"""

from __future__ import annotations

from typing import Literal

from ecm_checker.contract import Contract, Evidence, Identity, Interface, Resources, Signature, Source, Value

from ecm_extract.system.model import Place
from ecm_extract.system.node_model import Endpoint, SystemNode
from ecm_extract.system.system import System


def instance_contracts(system: System) -> tuple[Contract, ...]:
    """Return a contract for each node that is started for sure, by name; of two with one name the first.

    Its id is the name of the node in the graph, since that is what a person meets on the robot, and each endpoint has
    the lines that declare, start and remap it.
    What a launch starts only under a condition that is known later is left out: it may exclude something else.
    """
    claims = {_full(entry.namespace, entry.name): entry for entry in system.controllers if entry.active}
    found: dict[str, Contract] = {}
    for node in system.nodes:
        if node.instance.conditional or "{" in node.name:
            continue
        claimed = claims.get(node.name)
        locks = None
        if claimed is not None and claimed.claims is not None and claimed.known:
            evidence = (Evidence(claimed.place.path, claimed.place.line),)
            locks = Value(list(claimed.claims), "inferred", "folded", evidence)
        found.setdefault(node.name, _contract(system, node, locks))
    return tuple(found[name] for name in sorted(found))


def _contract(system: System, node: SystemNode, locks: Value | None) -> Contract:
    instance = node.instance
    ros: Literal[1, 2] = 1 if instance.ros == 1 else 2
    identity = Identity(
        module_id=node.name,
        package=instance.package,
        kind="controller" if instance.kind == "controller" else "node",
        version=None,
        source=Source(system.tree.repository, system.tree.commit, instance.place.path),
        ros=ros,
    )
    interfaces = tuple(_interface(entry, instance.place) for entry in node.endpoints)
    return Contract(identity, Signature(interfaces=interfaces), resources=Resources(exclusive_locks=locks))


def _interface(entry: Endpoint, start: Place) -> Interface:
    places = (entry.place, start, *(() if entry.remap is None else (entry.remap.place,)))
    return Interface(
        role=entry.role,
        name=entry.name,
        raw_name=entry.before,
        type=entry.type,
        qos=entry.qos,
        frame=None,
        confidence="folded" if entry.known else "pattern",
        evidence=tuple(Evidence(place.path, place.line) for place in dict.fromkeys(places)),
    )


def _full(namespace: str, name: str) -> str:
    return f"{namespace.rstrip('/')}/{name}"
