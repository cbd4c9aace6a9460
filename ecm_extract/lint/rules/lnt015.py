"""LNT015: a node uses a name that nothing in its system offers, while something offers a near one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.roles import joining_uses
from ecm_checker.match.engine import Match

from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.system.connections import Connections

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


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report users of names of the same type that differ in their last part only a little."""
    found: dict[str, Finding] = {}
    for system in workspace.systems:
        for finding in _of_system(Connections(system), workspace):
            found.setdefault(finding.fingerprint, finding)
    yield from found.values()


def _of_system(joined: Connections, workspace: Workspace) -> Iterator[Finding]:
    used: dict[str, set[str]] = {use: set() for use in joining_uses()}
    for each in joined.matches:
        used.get(each.requirement.use, set()).add(each.requirement.name)
    for each in joined.matches:
        near = _near(each, joined, used) if each.requirement.use in joining_uses() else None
        if near is not None:
            yield _finding(each.requirement, near, workspace)


def _near(found: Match, joined: Connections, used: Mapping[str, set[str]]) -> Provision | None:
    """What is offered beside the name that is asked for, nearly by that name, and not asked for by anybody."""
    wanted = found.requirement
    if found.found or wanted.type is None or wanted.certainty == "unknown" or wanted.name in _PEOPLE:
        return None
    fitting = (each for each in joined.offered(wanted.use) if wanted.type in {each.type, *each.others})
    free = (each for each in fitting if not each.is_computed and each.name not in used[wanted.use])
    namespace, _, last = wanted.name.rpartition("/")
    beside: dict[str, Provision] = {}
    for each in free:
        if each.name.rpartition("/")[0] == namespace:
            beside.setdefault(each.name.rpartition("/")[2], each)
    near = beside.get(nearest(last, beside, CUTOFF) or "")
    return near if near is not None and near.owner != wanted.by else None  # who uses `in` and offers `out` means both


def _finding(wanted: Requirement, near: Provision, workspace: Workspace) -> Finding:
    text = (
        f"{wanted.by} uses {wanted.said}, which nothing here offers; {near.owner} offers {near.name} of the same type"
    )
    evidence = [wanted.evidence[0], Evidence(near.path, near.line)]
    package = workspace.package_of(wanted.evidence[0].path)
    return RULE.finding(text, Entity("topic", near.name, wanted.said), package, evidence, certainty="likely")
