"""LNT039: the limits of a joint leave it no room to move."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.description.urdf import number_of
from ecm_extract.lint.robot_files import WrittenJoint, written_joints
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT039",
    name="joint_limits_closed",
    dimension="resources",
    severity="warning",
    who="safety",
    consequence="controllers that enforce limits hold the joint where it is, and planners find no path",
    resolution="give the joint its range, or remove the element",
)
_SIDES = {"limit": ("lower", "upper"), "safety_controller": ("soft_lower_limit", "soft_upper_limit")}


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report joints that move and whose limits, hard or soft, are equal or the wrong way round."""
    for joint in written_joints(workspace):
        if joint.kind not in {"revolute", "prismatic"}:
            continue
        for part, (low, high) in _SIDES.items():
            found = _range(joint.parts.get(part), low, high)
            if found is not None and found[0] >= found[1]:
                held = part == "limit" and {low, high} <= joint.parts[part].keys() and found == (0.0, 0.0)
                yield _finding(joint, part, found, "info" if held else "warning")


def _range(written: Mapping[str, str] | None, low: str, high: str) -> tuple[float, float] | None:
    """What is left out is zero, as URDF has it; None where a side is computed."""
    if written is None:
        return None
    sides = number_of(written.get(low, "0")), number_of(written.get(high, "0"))
    return None if sides[0] is None or sides[1] is None else (sides[0], sides[1])


def _finding(joint: WrittenJoint, part: str, found: tuple[float, float], severity: Severity) -> Finding:
    text = f"<{part}> of {joint.name} goes from {found[0]:g} to {found[1]:g}"
    place = [Evidence(joint.path, joint.line)]
    entity = Entity("joint", joint.name, part, joint.robot)
    return RULE.finding(text, entity, joint.package, place, severity=severity)
