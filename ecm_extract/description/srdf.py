"""SRDF: planning groups, end effectors, virtual joints and switched-off collisions of an expanded description.

Source: wiki.ros.org/srdf/review and the MoveIt documentation "URDF and SRDF".
"""

from __future__ import annotations

from collections.abc import Iterator

from ecm_extract.description.element import Element
from ecm_extract.description.model import EndEffector, PlanningGroup, Semantics, VirtualJoint, Where

_OWN = frozenset({"group", "end_effector", "virtual_joint", "disable_collisions", "group_state", "passive_joint"})


def semantics_of(root: Element) -> Semantics | None:
    """Return what an SRDF declares, None for a description that is none."""
    if not any(child.tag in _OWN for child in root.children):
        return None
    return Semantics(
        tuple(_group(entry) for entry in root.below("group")),
        tuple(_end_effector(entry) for entry in root.below("end_effector")),
        tuple(_virtual_joint(entry) for entry in root.below("virtual_joint")),
        tuple(_names(root, "passive_joint")),
        tuple((entry.get("group"), entry.get("name")) for entry in root.below("group_state")),
        sum(1 for _ in root.below("disable_collisions")),
    )


def _group(element: Element) -> PlanningGroup:
    return PlanningGroup(
        element.get("name"),
        tuple(_names(element, "joint")),
        tuple(_names(element, "link")),
        tuple((chain.get("base_link"), chain.get("tip_link")) for chain in element.below("chain")),
        tuple(_names(element, "group")),
        Where(element.path, element.line),
    )


def _end_effector(element: Element) -> EndEffector:
    return EndEffector(
        element.get("name"),
        element.get("group"),
        element.get("parent_link"),
        element.get("parent_group"),
        Where(element.path, element.line),
    )


def _virtual_joint(element: Element) -> VirtualJoint:
    return VirtualJoint(
        element.get("name"),
        element.get("type"),
        element.get("parent_frame"),
        element.get("child_link"),
        Where(element.path, element.line),
    )


def _names(element: Element, tag: str) -> Iterator[str]:
    return (entry.get("name") for entry in element.below(tag))
