"""LNT048: whoever reads any topic asks for more than some publishers of the workspace offer.

Source: ROS 2 documentation, "Quality of Service settings", compatibilities.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from ecm_checker.contract import Interface
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt008 import mismatch
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT048",
    name="generic_reader_strict",
    dimension="behavior",
    severity="warning",
    who="qos",
    consequence="of such a topic it gets nothing, and no error is shown",
    resolution="ask the graph for the policies of the publishers first, or let the user choose them",
)
_ANY: Final = re.compile(r"/?\{[^{}]*\}")
MAX_PLACES: Final = 3


class Reader(NamedTuple):
    """A subscription of a package to a topic whose name and type are known only when it runs."""

    package: str
    module: str
    interface: Interface


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each such reader once for each package that offers less."""
    publishers = _by_package(workspace)
    for reader in _readers(workspace):
        for package, offers in sorted(publishers.items()):
            weak = [(offer, mismatch(offer.qos, reader.interface.qos)) for offer in offers]
            found = [(offer, policy) for offer, policy in weak if policy is not None]
            if found and package != reader.package:
                yield _finding(reader, package, found)


def _readers(workspace: Workspace) -> Iterator[Reader]:
    for entry in workspace.linked:
        for interface in entry.interfaces:
            generic = interface.type is None and _ANY.fullmatch(interface.name) is not None
            if interface.role == "subscriber" and generic and interface.qos is not None:
                yield Reader(entry.module.package, entry.module.name, interface)


def _by_package(workspace: Workspace) -> dict[str, list[Interface]]:
    found: dict[str, list[Interface]] = {}
    for entry in workspace.linked:
        known = [each for each in entry.interfaces if each.role == "publisher" and "{" not in each.name and each.qos]
        found.setdefault(entry.module.package, []).extend(known)
    return found


def _finding(reader: Reader, package: str, weak: Sequence[tuple[Interface, str]]) -> Finding:
    offer, policy = weak[0]
    asked, given = getattr(reader.interface.qos, policy), getattr(offer.qos, policy)
    text = (
        f"{reader.module} subscribes to any topic with {policy} {asked}, "
        f"and {package} publishes {offer.name} with {given}"
    )
    evidence = [*reader.interface.evidence[:1], *(entry.evidence[0] for entry, _ in weak[:MAX_PLACES])]
    entity = Entity("topic", reader.interface.name, package)
    return RULE.finding(text, entity, reader.package, evidence, certainty="likely")
