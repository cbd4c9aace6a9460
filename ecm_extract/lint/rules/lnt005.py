"""LNT005: a launch or parameter file sets a parameter that its node does not read."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.near import slip
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.system.own_names import Filled, filled

RULE = LintRule(
    id="LNT005",
    name="parameter_unread",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="the value has no effect and the node runs with its default",
    resolution="correct the name, or remove the line",
    tier="stable",
)
NEAR = 0.86


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report unread parameters with a near one that is read; without one the tool may not see who reads it."""
    found: dict[str, Finding] = {}
    for each in (each for system in workspace.systems for each in filled(system.nodes)):
        finding = _of(each, workspace) if each.match.state == "dangling" else None
        if finding is not None:
            found.setdefault(finding.fingerprint, finding)
    yield from found.values()


def _of(found: Filled, workspace: Workspace) -> Finding | None:
    name, node, evidence = found.parameter.name, found.node, found.match.requirement.evidence
    near = _nearest(name, [entry.name for entry in node.parameters if entry.declared])
    if near is None or any(entry.name == near and entry.place is not None for entry in node.parameters):
        return None
    text = f"{node.name} does not read {name}; it reads {near}"
    entity = Entity("parameter", name, near, node.name)
    package = workspace.package_of(evidence[0].path)
    edit = slip(name, near)
    return RULE.finding(text, entity, package, evidence, certainty="likely", resolution=f"write {near}", edit=edit)


def _nearest(name: str, declared: list[str]) -> str | None:
    """Return the parameter that a name is most like; differing numbers are differing things."""
    best, score = None, NEAR
    matcher = SequenceMatcher(None, name)
    for other in declared:
        if _digits(name) != _digits(other):
            continue
        matcher.set_seq2(other)
        if matcher.real_quick_ratio() > score and matcher.quick_ratio() > score and matcher.ratio() > score:
            best, score = other, matcher.ratio()
    return best


def _digits(text: str) -> str:
    return "".join(char for char in text if char.isdigit())
