"""`<ros2_control>` blocks and ROS 1 transmissions.

Sources: control.ros.org "Hardware components", wiki.ros.org/urdf/XML/Transmission.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_extract.description.element import Element
from ecm_extract.description.model import Hardware, HardwarePart, Transmission, Where

_PARTS = ("joint", "sensor", "gpio")


def hardware_of(root: Element) -> Iterator[Hardware]:
    """Yield the hardware blocks of a description."""
    for element in root.walk():
        if element.tag == "ros2_control" and ("name" in element.attributes or element.first("hardware") is not None):
            yield _hardware(element)


def _hardware(element: Element) -> Hardware:
    driver = element.first("hardware")
    inside = driver if driver is not None else element
    return Hardware(
        name=element.get("name"),
        kind=element.get("type").lower(),
        plugin=inside.content("plugin"),
        parameters={entry.get("name"): entry.text.strip() for entry in inside.below("param")},
        parts=tuple(_merged(_part(child) for child in element.children if child.tag in _PARTS)),
        conditional=element.conditional or inside.conditional,
        where=Where(element.path, element.line),
    )


def _part(element: Element) -> HardwarePart:
    return HardwarePart(
        element.tag,  # type: ignore[arg-type]
        element.get("name"),
        tuple(dict.fromkeys(entry.get("name") for entry in element.below("command_interface"))),
        tuple(dict.fromkeys(entry.get("name") for entry in element.below("state_interface"))),
        Where(element.path, element.line),
    )


def _merged(parts: Iterable[HardwarePart]) -> list[HardwarePart]:
    """Join parts that two branches of a condition both write."""
    found: dict[tuple[str, str], HardwarePart] = {}
    for part in parts:
        known = found.get((part.kind, part.name))
        if known is not None:
            command = tuple(dict.fromkeys((*known.command, *part.command)))
            state = tuple(dict.fromkeys((*known.state, *part.state)))
            part = HardwarePart(part.kind, part.name, command, state, known.where)
        found[part.kind, part.name] = part
    return list(found.values())


def transmissions_of(root: Element) -> Iterator[Transmission]:
    """Yield the ROS 1 transmissions of a description."""
    for element in root.below("transmission"):
        joints = [
            (joint.get("name"), tuple(_bare(entry.text) for entry in joint.below("hardwareInterface")))
            for joint in element.below("joint")
        ]
        shared = tuple(
            _bare(entry.text) for actuator in element.below("actuator") for entry in actuator.below("hardwareInterface")
        )
        yield Transmission(
            element.get("name"),
            element.content("type") or element.get("type"),
            tuple((name, own or shared) for name, own in joints),
            Where(element.path, element.line),
        )


def _bare(text: str) -> str:
    """`hardware_interface/PositionJointInterface` and `PositionJointInterface` are the same."""
    return text.strip().rpartition("/")[2]
