"""`<ros2_control>` blocks.

Source: control.ros.org "Hardware components".
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_extract.description.element import Element
from ecm_extract.description.model import Hardware, HardwarePart, Where
from ecm_extract.description.urdf import number_of

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
        dict(_limits(element)),
        {entry.get("name"): entry.text.strip() for entry in element.below("param")},
    )


def _limits(element: Element) -> Iterator[tuple[str, tuple[float | None, float | None]]]:
    """Yield lowest and highest command of the interfaces that have them."""
    for entry in element.below("command_interface"):
        written = {param.get("name"): number_of(param.text) for param in entry.below("param")}
        pair = (written.get("min"), written.get("max"))
        if pair != (None, None):
            yield entry.get("name"), pair


def _merged(parts: Iterable[HardwarePart]) -> list[HardwarePart]:
    """Join parts that two branches of a condition both write."""
    found: dict[tuple[str, str], HardwarePart] = {}
    for part in parts:
        known = found.get((part.kind, part.name))
        if known is not None:
            command = tuple(dict.fromkeys((*known.command, *part.command)))
            state = tuple(dict.fromkeys((*known.state, *part.state)))
            limits, parameters = {**part.limits, **known.limits}, {**part.parameters, **known.parameters}
            part = HardwarePart(part.kind, part.name, command, state, known.where, limits, parameters)
        found[part.kind, part.name] = part
    return list(found.values())
