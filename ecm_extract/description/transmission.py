"""Transmissions: of ROS 1, which name hardware interfaces, and those inside `<ros2_control>`.

Sources: wiki.ros.org/urdf/XML/Transmission; control.ros.org "Transmission interface".
"""

from __future__ import annotations

from collections.abc import Iterator

from ecm_extract.description.element import Element
from ecm_extract.description.model import Transmission, Where


def transmissions_of(root: Element) -> Iterator[Transmission]:
    """Yield the transmissions of a description."""
    for element in root.walk():
        if element.tag == "transmission" and element.children:
            yield _transmission(element)


def _transmission(element: Element) -> Transmission:
    actuators = list(element.below("actuator"))
    shared = tuple(name for actuator in actuators for name in _interfaces(actuator))  # early files write them here
    return Transmission(
        element.get("name"),
        element.content("type") or element.content("plugin") or element.get("type"),
        tuple((joint.get("name"), _interfaces(joint) or shared) for joint in element.below("joint")),
        Where(element.path, element.line),
        tuple(actuator.get("name") for actuator in actuators),
    )


def _interfaces(element: Element) -> tuple[str, ...]:
    """Return the interfaces; `hardware_interface/PositionJointInterface` and `PositionJointInterface` are the same."""
    return tuple(entry.text.strip().rpartition("/")[2] for entry in element.below("hardwareInterface"))
