"""LNT027: a checked-in URDF differs from the xacro beside it that it was made from."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.description.model import Description, Joint
from ecm_extract.description.read import read_description
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT027",
    name="urdf_drifted",
    dimension="resources",
    severity="warning",
    who="safety",
    consequence="who loads the one plans for another robot than who loads the other",
    resolution="make the URDF anew from the xacro, or correct the xacro",
)
_TOLERANCE = 1e-3
_SHOWN = 6
_ANGLES = ("origin roll", "origin pitch", "origin yaw")
_PLACE = ("origin x", "origin y", "origin z", *_ANGLES)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report joints whose kind, links, place or limits differ between `x.urdf` and `x.xacro` or `x.urdf.xacro`."""
    for package in workspace.packages:
        listed = {entry.path for entry in package.root.files}
        for path in sorted(listed):
            stem = path.removesuffix(".urdf")
            source = next((stem + end for end in (".urdf.xacro", ".xacro") if stem + end in listed), None)
            if path.endswith(".urdf") and source is not None:
                made, written = (read_description(name, {}, workspace.files) for name in (source, path))
                if made.links and written.links and not made.problems:
                    yield from _compared(made, written, package.name)


def _compared(made: Description, written: Description, package: str) -> Iterator[Finding]:
    """One stale file is one finding, with the lines of each joint that differs."""
    joints = {joint.name: joint for joint in made.joints}
    found = [
        (joint, source, what)
        for joint in written.joints
        if (source := joints.get(joint.name)) is not None and (what := _difference(source, joint)) is not None
    ]
    if found:
        joint, source, what = found[0]
        text = f"{joint.name} of {written.path} has {what}{_others([other.name for other, _, _ in found[1:]])}"
        evidence = [Evidence(*place) for other, origin, _ in found for place in (other.where, origin.where)]
        entity = Entity("joint", joint.name, what.partition(",")[0].rpartition(" ")[0], written.name)
        yield RULE.finding(text, entity, package, evidence, certainty="likely")


def _others(names: Sequence[str]) -> str:
    """The joints that differ as well, by name as far as people read them."""
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"; {', '.join(names[:_SHOWN])}{more} differ{'s' * (len(names) == 1)} too" if names else ""


def _difference(source: Joint, joint: Joint) -> str | None:
    for name in ("kind", "parent", "child"):
        own, made = getattr(joint, name), getattr(source, name)
        if own != made and not made.endswith(f"/{own}"):  # the xacro puts the namespace of its robot before links
            return f"{name} {own}, its xacro {made}"
    for name, value in joint.limits.items():
        other = source.limits.get(name)
        if other is not None and _differs(other, value):
            return f"{name} {value:g}, its xacro {other:g}"
    for name, value, other in zip(_PLACE, joint.origin or (), source.origin or (), strict=False):
        turned = name in _ANGLES and not _differs(math.remainder(other - value, math.tau), 0.0)
        if _differs(other, value) and not turned:
            return f"{name} {value:g}, its xacro {other:g}"
    return None


def _differs(one: float, other: float) -> bool:
    return abs(one - other) > _TOLERANCE * max(1.0, abs(other))
