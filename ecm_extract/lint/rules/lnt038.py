"""LNT038: the origin of a joint is turned by pi, or half of it, rounded to a few digits."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.robot_files import WrittenJoint, written_joints
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT038",
    name="joint_origin_rounded",
    dimension="signature",
    severity="info",
    who="safety",
    consequence="the frames behind it are turned a little, and what is planned far behind it misses",
    resolution="write ${pi} or ${pi/2} in xacro, or all digits",
)
_CLOSE = 0.002
_DIGITS = 4
"""After the point; who writes more means the number to be exact."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report the first such angle of each joint."""
    for joint in written_joints(workspace):
        written = next((text for text in joint.parts.get("origin", {}).get("rpy", "").split() if _is_rounded(text)), "")
        if written:
            yield _finding(joint, written)


def _is_rounded(text: str) -> bool:
    try:
        value = float(text)
    except ValueError:
        return False
    halves = round(value / (math.pi / 2)) if math.isfinite(value) else 0
    digits = len(text.partition(".")[2])
    return halves != 0 and digits <= _DIGITS and abs(value - halves * math.pi / 2) < _CLOSE


def _finding(joint: WrittenJoint, written: str) -> Finding:
    text = f"the origin of {joint.name} is turned by {written}, which is pi or half of it, rounded"
    place = [Evidence(joint.path, joint.line)]
    return RULE.finding(text, Entity("joint", joint.name, written, joint.robot), joint.package, place)
