"""LNT012: several nodes of one launched system write an actuation topic, and no multiplexer chooses between them."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.assemble.resources import hardware_table
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.switches import Switches
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.node_model import Endpoint, SystemNode
from ecm_extract.system.system import System

RULE = LintRule(
    id="LNT012",
    name="several_writers",
    dimension="resources",
    severity="warning",
    who="safety",
    consequence="the robot follows whichever command came last",
    resolution="put a multiplexer between them, or give each its own topic",
)
_SHOWN = 5
_CHOOSERS = ("mux", "multiplexer", "arbiter", "selector")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report a topic once for the lines that write it, whichever nodes run them."""
    seen = set()
    switches = Switches(workspace)
    for system in workspace.systems:
        for name, writers in _written(system, switches).items():
            nodes = sorted({entry.node for entry in writers})
            lines = tuple(dict.fromkeys(entry.place for entry in writers))
            key = (name, frozenset(lines))
            if len(nodes) > 1 and key not in seen and not any(word in node for node in nodes for word in _CHOOSERS):
                seen.add(key)
                more = f" and {len(nodes) - _SHOWN} more" if len(nodes) > _SHOWN else ""
                text = f"{', '.join(nodes[:_SHOWN])}{more} all publish {name}"
                evidence = [evidence_of(line) for line in lines]
                package = workspace.package_of(writers[0].place.path)
                yield RULE.finding(text, Entity("topic", name, " ".join(nodes)), package, evidence, certainty="likely")


def _written(system: System, switches: Switches) -> dict[str, list[Endpoint]]:
    table = hardware_table()
    found: dict[str, list[Endpoint]] = {}
    for node in system.nodes:
        if node.instance.conditional:
            continue
        for entry in node.endpoints:
            moves = entry.known and table.moved(entry.role, entry.type, entry.name) is not None
            if entry.row.writes and moves and not _relays(node, entry.name) and not switches.is_off(entry, node):
                found.setdefault(entry.name, []).append(entry)
    return found


def _relays(node: SystemNode, topic: str) -> bool:
    """Tell whether a node reads the topic as well: a bridge hands on what the others say."""
    return any(entry.row.reads and entry.name == topic for entry in node.endpoints)
