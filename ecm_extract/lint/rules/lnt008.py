"""LNT008: publisher and subscriber of one topic ask for delivery policies that do not fit, in one launched system."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Qos
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.node_model import Endpoint
from ecm_extract.system.system import System

RULE = LintRule(
    id="LNT008",
    name="qos_incompatible",
    dimension="behavior",
    severity="error",
    who="qos",
    consequence="the middleware connects neither side and no message arrives",
    resolution="ask for no more than the publisher offers, or let the publisher offer more",
)
_STRENGTH = {
    "reliability": {"best_effort": 0, "reliable": 1},
    "durability": {"volatile": 0, "transient_local": 1},
}


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each pair of lines once."""
    seen = set()
    for system in workspace.systems:
        for publisher, subscriber in _pairs(system):
            policy = mismatch(publisher.qos, subscriber.qos)
            key = (publisher.place, subscriber.place, policy)
            if policy is not None and key not in seen:
                seen.add(key)
                yield _finding(policy, publisher, subscriber, workspace)


def mismatch(offered: Qos | None, asked: Qos | None) -> str | None:
    """Return the policy in which a subscriber asks for more than a publisher offers, None when all fit."""
    for policy, strength in _STRENGTH.items():
        one, two = getattr(offered, policy, None), getattr(asked, policy, None)
        if one in strength and two in strength and strength[one] < strength[two]:
            return policy
    return None


def _pairs(system: System) -> Iterator[tuple[Endpoint, Endpoint]]:
    every = [entry for node in system.nodes if node.instance.ros == 2 for entry in node.endpoints if entry.known]
    for subscriber in every:
        if subscriber.row.reads and subscriber.qos is not None:
            for publisher in every:
                same = publisher.name == subscriber.name and publisher.type == subscriber.type
                if publisher.row.writes and same and publisher.qos is not None:
                    yield publisher, subscriber


def _finding(policy: str, publisher: Endpoint, subscriber: Endpoint, workspace: Workspace) -> Finding:
    offered, asked = getattr(publisher.qos, policy), getattr(subscriber.qos, policy)
    text = f"{publisher.node} publishes {publisher.name} {offered}, {subscriber.node} asks for {asked}"
    evidence = [evidence_of(subscriber.place), evidence_of(publisher.place)]
    entity = Entity("qos", f"{publisher.name} {policy} {offered}", asked)
    return RULE.finding(text, entity, workspace.package_of(subscriber.place.path), evidence)
