"""LNT015: a node uses a name that nothing in its system offers, while something offers a near one."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.node_model import Endpoint
from ecm_extract.system.system import System

RULE = LintRule(
    id="LNT015",
    name="name_near_miss",
    dimension="signature",
    severity="warning",
    who="graph",
    consequence="the subscriber or client waits for ever, without an error",
    resolution="use one name on both sides, or remap it",
)
CUTOFF = 0.84
_PEOPLE = frozenset({"/initialpose", "/goal_pose", "/clicked_point", "/move_base_simple/goal"})
"""What people give with the tools of rviz, which need no launch file."""
_OFFERS = {"subscriber": "publisher", "service_client": "service_server", "action_client": "action_server"}


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report users of names of the same type that differ in their last part only a little.

    No requirement of packages: the other side is a node of one evaluated system, not a package.
    """
    seen = set()
    for system in workspace.systems:
        offered = _offered(system)
        for node in system.nodes:
            for entry in node.endpoints:
                finding = _of(entry, offered, workspace)
                if finding is not None and finding.fingerprint not in seen:
                    seen.add(finding.fingerprint)
                    yield finding


def _offered(system: System) -> dict[tuple[str, str | None], dict[str, Endpoint]]:
    found: dict[tuple[str, str | None], dict[str, Endpoint]] = {}
    for node in system.nodes:
        for entry in node.endpoints:
            if entry.known:
                found.setdefault((entry.role, entry.type), {}).setdefault(entry.name, entry)
    return found


def _of(
    entry: Endpoint, offered: dict[tuple[str, str | None], dict[str, Endpoint]], workspace: Workspace
) -> Finding | None:
    role = _OFFERS.get(entry.role)
    if role is None or entry.type is None or not entry.known or entry.name in _PEOPLE:
        return None
    providers = offered.get((role, entry.type), {})
    used = {other for (kind, _), names in offered.items() if kind == entry.role for other in names}
    free = [name for name in providers if name not in used]
    if entry.name in providers or not free:
        return None
    namespace, _, last = entry.name.rpartition("/")
    beside = {name.rpartition("/")[2]: name for name in free if name.rpartition("/")[0] == namespace}
    near = nearest(last, beside, CUTOFF)
    if near is None or providers[beside[near]].node == entry.node:
        return None  # a node that uses `in` and offers `out` means both
    near = beside[near]
    provider = providers[near]
    text = f"{entry.node} uses {entry.name}, which nothing here offers; {provider.node} offers {near} of the same type"
    evidence = [evidence_of(entry.place), evidence_of(provider.place)]
    package = workspace.package_of(entry.place.path)
    return RULE.finding(text, Entity("topic", near, entry.name), package, evidence, certainty="likely")
