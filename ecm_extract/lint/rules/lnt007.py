"""LNT007: publishers and subscribers of one topic use different types, in a system that a launch file starts."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.roles import linked_roles

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.node_model import Endpoint
from ecm_extract.system.system import System

RULE = LintRule(
    id="LNT007",
    name="types_differ",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="the two are never connected and no message arrives",
    resolution="use one type on both sides, or two names",
)
_ANY = frozenset({"rospy/msg/AnyMsg", "topic_tools/msg/ShapeShifter"})
"""Types of a side that takes messages as they come."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report channels whose two sides share no type."""
    seen = set()
    for system in workspace.systems:
        for name, offers, uses in _channels(system):
            finding = _compared(name, offers, uses, workspace)
            if finding is not None and finding.fingerprint not in seen:
                seen.add(finding.fingerprint)
                yield finding


def _channels(system: System) -> Iterator[tuple[str, list[Endpoint], list[Endpoint]]]:
    for offer, use in linked_roles():
        by_name: dict[str, tuple[list[Endpoint], list[Endpoint]]] = {}
        for node in system.nodes:
            for entry in node.endpoints:
                named = entry.known and entry.type is not None and entry.type not in _ANY
                if entry.role in (offer, use) and named and node.modules:
                    by_name.setdefault(entry.name, ([], []))[entry.role == use].append(entry)
        yield from ((name, offers, uses) for name, (offers, uses) in sorted(by_name.items()))


def _compared(name: str, offers: list[Endpoint], uses: list[Endpoint], workspace: Workspace) -> Finding | None:
    offered, used = {entry.type for entry in offers}, {entry.type for entry in uses}
    if not offered or not used or offered & used or name in {"/tf", "/tf_static"}:
        return None
    first, second = offers[0], uses[0]
    text = f"{first.node} offers {name} as {first.type}, {second.node} uses it as {second.type}"
    evidence: list[Evidence] = [evidence_of(second.place), evidence_of(first.place)]
    entity = Entity("topic", str(first.type), str(second.type))
    return RULE.finding(text, entity, workspace.package_of(second.place.path), evidence)
