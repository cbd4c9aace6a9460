"""Names that a robot description declares and refers to, as they are written: nothing is included or expanded.

Sources: wiki.ros.org/urdf/XML; wiki.ros.org/xacro; control.ros.org `<ros2_control>`.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from lxml import etree

from ecm_parsers.result import Parsed
from ecm_parsers.xml_tree import children, line_of, local_name, parse_xml

MAX_NAMES = 5_000
_AROUND = frozenset({"robot", "macro", "if", "unless"})
"""Elements between the root and a link; `<link>` elsewhere is one of a simulator or a planning group."""


class NamedLine(msgspec.Struct, frozen=True):
    """A name as written, `${prefix}` included, with its 1-based line."""

    name: str
    line: int


class RobotNames(msgspec.Struct, frozen=True):
    """What one file has.

    Attributes:
        links: that it declares. commands: `joint/interface` of its hardware.
        parents: links that its joints name, whoever declares them. includes: files, as written.
    """

    links: tuple[NamedLine, ...] = ()
    commands: tuple[NamedLine, ...] = ()
    parents: tuple[NamedLine, ...] = ()
    includes: tuple[NamedLine, ...] = ()


def parse_robot_names(data: bytes) -> Parsed[RobotNames]:
    """Read a URDF or xacro file."""
    tree = parse_xml(data)
    if tree.root is None or local_name(tree.root) != "robot":
        return Parsed(RobotNames(), tree.diagnostics)
    placed = list(_placed(tree.root))[:MAX_NAMES]
    names = RobotNames(
        links=tuple(_named(element, "name") for tag, element in placed if tag == "link" and element.get("name")),
        commands=tuple(entry for tag, element in placed if tag == "ros2_control" for entry in _commands(element)),
        parents=tuple(entry for tag, element in placed if tag == "joint" for entry in _ends(element)),
        includes=tuple(_named(element, "filename") for tag, element in placed if tag == "include"),
    )
    return Parsed(names, tree.diagnostics)


def _placed(element: etree._Element) -> Iterator[tuple[str, etree._Element]]:
    for tag, child in children(element):
        yield tag, child
        if tag in _AROUND:
            yield from _placed(child)


def _named(element: etree._Element, attribute: str) -> NamedLine:
    return NamedLine(str(element.get(attribute, "")), line_of(element))


def _commands(hardware: etree._Element) -> Iterator[NamedLine]:
    for part in hardware.iter(etree.Element):
        for tag, command in children(part):
            if tag == "command_interface" and part.get("name") and command.get("name"):
                yield NamedLine(f"{part.get('name')}/{command.get('name')}", line_of(command))


def _ends(joint: etree._Element) -> Iterator[NamedLine]:
    for tag, element in children(joint):
        if tag in {"parent", "child"} and element.get("link"):
            yield _named(element, "link")
