"""Simulator plugins and sensors of an expanded description.

Sources: sdformat.org `<plugin>` and `<sensor>`; the `<ros>` block of gazebo_ros.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from ecm_extract.description.element import Element
from ecm_extract.description.model import Sensor, SimulatorPlugin, Where
from ecm_extract.description.urdf import number_of

_HARDWARE = frozenset({"ros2_control", "transmission"})
"""Elements whose plugins and sensors are not the simulator's."""
_FRAMES = ("gz_frame_id", "ignition_frame_id", "frame_id")


@dataclass(frozen=True, slots=True)
class _Around:
    """The link and the sensor that an element stands in."""

    link: str = ""
    sensor: str = ""
    sensor_kind: str = ""


def sensors_of(root: Element) -> Iterator[Sensor]:
    """Yield the sensors that a simulator makes, wherever they stand."""
    for around, element in _found(root, "sensor"):
        yield Sensor(
            element.get("name"),
            element.get("type"),
            around.link,
            number_of(element.content("update_rate") or element.get("update_rate")),
            element.content("topic"),
            Where(element.path, element.line),
            tuple(entry.get("filename") for entry in element.below("plugin")),
            next((text for tag in _FRAMES if (text := element.content(tag))), ""),
        )


def plugins_of(root: Element) -> Iterator[SimulatorPlugin]:
    """Yield the plugins of a simulator."""
    for around, element in _found(root, "plugin"):
        if not element.get("filename"):
            continue
        ros = element.first("ros")
        yield SimulatorPlugin(
            element.get("filename"),
            element.get("name"),
            {entry.tag: entry.text.strip() for entry in element.children if not entry.children},
            tuple(_remaps(ros if ros is not None else element)),
            (ros.content("namespace") if ros is not None else "") or element.content("robotNamespace"),
            around.link,
            Where(element.path, element.line),
            around.sensor,
            around.sensor_kind,
            ros is not None,
            tuple(entry.text.strip() for entry in element.children if entry.tag == "parameters"),
        )


def _remaps(element: Element) -> Iterator[tuple[str, str]]:
    """The rules of a plugin; earlier releases take them as arguments of the node."""
    for entry in (*element.below("remapping"), *element.below("argument")):
        source, separator, target = entry.text.strip().removeprefix("-r").partition(":=")
        if separator and not source.strip().startswith("__"):
            yield source.strip(), target.strip()


def _found(root: Element, tag: str) -> Iterator[tuple[_Around, Element]]:
    """Yield the elements of a tag in document order with what they stand in."""
    pending = [(_Around(), root)]
    while pending:
        around, element = pending.pop()
        if element.tag == tag:
            yield around, element
        if element.tag in _HARDWARE:
            continue
        inner = _inside(around, element)
        pending.extend((inner, child) for child in reversed(element.children))


def _inside(around: _Around, element: Element) -> _Around:
    if element.tag == "link":
        return replace(around, link=element.get("name"))
    if element.tag == "gazebo" and element.get("reference"):
        return replace(around, link=element.get("reference"))
    if element.tag == "sensor":
        return replace(around, sensor=element.get("name"), sensor_kind=element.get("type"))
    return around
