"""A node has an endpoint that no contract names."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding, Severity
from ecm_checker.view import View

from ecm_extract.observe.expected import graph_keys
from ecm_extract.observe.model import Endpoint
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.standard import is_standard
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS002",
    name="endpoint_of_no_contract",
    dimension="signature",
    severity="warning",
    who="graph",
    consequence="nothing of it was checked before the robot ran",
    resolution="extract the contract of the version that runs, or fill its open names from what was seen (--complete)",
)
_MOST_NAMES = 6


def check(watch: Watch) -> Iterator[Finding]:
    """Endpoints of nodes that have a contract, and one finding for each node that has none."""
    if not watch.modules:
        return
    for node in watch.node_names:
        ends = [end for end in watch.by_node.get(node, ()) if not is_standard(end.role, end.name, node)]
        modules = watch.modules_of.get(node)
        if modules:
            yield from _unnamed(watch, node, modules, ends)
        elif ends:
            yield _stranger(node, ends)


def _unnamed(watch: Watch, node: str, modules: tuple[View, ...], ends: list[Endpoint]) -> Iterator[Finding]:
    """A contract with a name of the same role that stays a pattern may well mean this one."""
    promises = watch.expected_on[node]
    named = {key for each in promises for key in graph_keys(each)}
    open_roles = {role for each in promises if "{" in each.name for role, _ in graph_keys(each)}
    for end in ends:
        if (end.role, end.name) not in named:
            maybe = " unless one of its open names is this one" if end.role in open_roles else ""
            text = f"{node} has the {end.role.replace('_', ' ')} {end.name} [{end.type or 'type not told'}], which its "
            text += f"contract does not name{maybe}"
            subjects = (*(module.id for module in modules), node)
            severity: Severity | None = "info" if maybe else None
            yield RULE.seen(text, Entity(end.role, end.name), subjects, certainty="likely", severity=severity)


def _stranger(node: str, ends: list[Endpoint]) -> Finding:
    names = ", ".join(end.name for end in ends[:_MOST_NAMES]) + (" ..." if len(ends) > _MOST_NAMES else "")
    text = f"{node} is the node of no contract that was given, with {len(ends)} endpoint(s): {names}"
    return RULE.seen(text, Entity("node", node), (node,), severity="info")
