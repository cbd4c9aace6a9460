"""LNT016: a joint limit is pi, rounded up, so that it lies beyond pi."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.description.model import Joint
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT016",
    name="joint_limit_rounded",
    dimension="resources",
    severity="warning",
    who="safety",
    consequence="planners take the joint to turn further than that, and kinematics solvers reject or wrap it",
    resolution="write ${pi}, or round towards zero",
)
_CLOSE = 0.002


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report limits of joints that exceed a multiple of half a turn by a rounding."""
    seen = set()
    for description in workspace.descriptions:
        for joint in description.joints:
            if joint.kind == "continuous":
                continue  # it has no limits, whatever is written
            for side in ("lower", "upper"):
                value = joint.limits.get(side)
                if value is None or not _is_rounded(abs(value)) or joint.where in seen:
                    continue
                seen.add(joint.where)
                text = f"{joint.name} has the {side} limit {value:g}, which is beyond {_multiple(abs(value))} pi"
                severity: Severity = "warning" if _multiple(abs(value)) == 1 and _turns_fully(joint) else "info"
                evidence = [Evidence(joint.where.path, joint.where.line)]
                entity = Entity("joint", joint.name, side, description.name)
                package = workspace.package_of(joint.where.path)
                yield RULE.finding(text, entity, package, evidence, severity=severity)


def _multiple(value: float) -> int:
    return round(value / math.pi)


def _is_rounded(value: float) -> bool:
    excess = value - _multiple(value) * math.pi
    return _multiple(value) > 0 and 1e-9 < excess < _CLOSE


def _turns_fully(joint: Joint) -> bool:
    """Tell whether a joint can take an angle in two ways, which is where a solver and a planner part."""
    lower, upper = joint.limits.get("lower"), joint.limits.get("upper")
    return lower is None or upper is None or upper - lower > math.tau - _CLOSE
