"""URDF: links, joints, sensors and simulator plugins of an expanded description.

Sources: wiki.ros.org/urdf/XML; sdformat.org `<plugin>` and `<sensor>`; gazebo_ros `<ros>` parameters.
"""

from __future__ import annotations

from collections.abc import Iterator

from ecm_extract.description.element import Element
from ecm_extract.description.model import Joint, Link, Sensor, SimulatorPlugin, Where

_LIMITS = ("lower", "upper", "effort", "velocity")


def links_of(root: Element) -> Iterator[Link]:
    """Yield the links."""
    return (Link(entry.get("name"), Where(entry.path, entry.line)) for entry in root.below("link"))


def joints_of(root: Element) -> Iterator[Joint]:
    """Yield the joints."""
    for element in root.below("joint"):
        parent, child, mimic = element.first("parent"), element.first("child"), element.first("mimic")
        limit = element.first("limit")
        written = {name: limit.get(name) for name in _LIMITS if limit.get(name)} if limit is not None else {}
        yield Joint(
            element.get("name"),
            element.get("type"),
            parent.get("link") if parent is not None else "",
            child.get("link") if child is not None else "",
            {name: number for name, text in written.items() if (number := _number(text)) is not None},
            mimic.get("joint") if mimic is not None else None,
            Where(element.path, element.line),
        )


def sensors_of(root: Element) -> Iterator[Sensor]:
    """Yield the sensors that a simulator makes, wherever they stand."""
    for holder, element in _with_holder(root, "sensor"):
        if holder.tag == "ros2_control":
            continue
        yield Sensor(
            element.get("name"),
            element.get("type"),
            holder.get("reference") or holder.get("name"),
            _number(element.content("update_rate") or element.get("update_rate")),
            element.content("topic"),
            Where(element.path, element.line),
        )


def plugins_of(root: Element) -> Iterator[SimulatorPlugin]:
    """Yield the plugins of a simulator."""
    for holder, element in _with_holder(root, "plugin"):
        if not element.get("filename"):
            continue
        ros = element.first("ros")
        yield SimulatorPlugin(
            element.get("filename"),
            element.get("name"),
            {entry.tag: entry.text.strip() for entry in element.children if not entry.children},
            tuple(_remaps(ros if ros is not None else element)),
            (ros.content("namespace") if ros is not None else "") or element.content("robotNamespace"),
            holder.get("reference") or holder.get("name"),
            Where(element.path, element.line),
        )


def _remaps(element: Element) -> Iterator[tuple[str, str]]:
    for entry in element.below("remapping"):
        source, separator, target = entry.text.partition(":=")
        if separator:
            yield source.strip(), target.strip()


def _with_holder(root: Element, tag: str) -> Iterator[tuple[Element, Element]]:
    """Yield elements with the element of a link, or `<gazebo>`, that they stand in."""
    for top in root.children:
        for element in top.walk():
            if element.tag == tag and element is not top:
                yield top, element


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
