"""LNT005: a launch or parameter file sets a parameter that its node does not read."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.near import slip
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.node_model import Parameter, SystemNode
from ecm_extract.system.system import System

RULE = LintRule(
    id="LNT005",
    name="parameter_unread",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="the value has no effect and the node runs with its default",
    resolution="correct the name, or remove the line",
)
_ALWAYS = ("use_sim_time", "qos_overrides", "start_type_description_service", "robot_description", "use_intra_process")
NEAR = 0.86


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report unread parameters with a near one that is read; without one the tool may not see who reads it.

    No requirement of packages: the other side is a node of one evaluated system, not a package.
    """
    seen = set()
    for system in workspace.systems:
        for node in system.nodes:
            if node.guessed or not node.modules:
                continue
            declared = [entry.name for entry in node.parameters if entry.declared]
            beside = _read_beside(node, system)
            for parameter in node.parameters:
                finding = None if parameter.name in beside else _of(parameter, node, declared, workspace)
                if finding is not None and finding.fingerprint not in seen:
                    seen.add(finding.fingerprint)
                    yield finding


def _read_beside(node: SystemNode, system: System) -> set[str]:
    """Parameters that other nodes of the same process read: they are given the same ones."""
    place = node.instance.place
    others = [other for other in system.nodes if other.instance.place == place and other is not node]
    return {entry.name for other in others for entry in other.parameters if entry.declared}


def _of(parameter: Parameter, node: SystemNode, declared: list[str], workspace: Workspace) -> Finding | None:
    if parameter.declared is not False or parameter.place is None or parameter.name.startswith(_ALWAYS):
        return None
    if any(parameter.name.startswith(f"{name}/") for name in declared):
        return None  # it is read with the whole map that it stands in
    if any(entry.value == parameter.name for entry in node.parameters):
        return None  # another parameter says that it is to be read
    near = _nearest(parameter.name, declared)
    if near is None or any(entry.name == near and entry.place is not None for entry in node.parameters):
        return None
    text = f"{node.name} does not read {parameter.name}; it reads {near}"
    entity = Entity("parameter", parameter.name, near, node.name)
    package = workspace.package_of(parameter.place.path)
    evidence = [evidence_of(parameter.place)]
    edit = slip(parameter.name, near)
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
