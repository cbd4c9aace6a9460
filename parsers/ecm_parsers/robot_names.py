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
_TESTS = frozenset({"if", "unless"})
_ROBOT = "robot"
_MACRO = "macro"
_AROUND = frozenset({_ROBOT, _MACRO, "if", "unless"})
"""Elements between the root and a link; `<link>` elsewhere is one of a simulator or a planning group."""


class Guard(msgspec.Struct, frozen=True):
    """What `<xacro:if>` or `<xacro:unless>` asks for: a value as written, which must hold, or with `negated` not."""

    value: str
    negated: bool = False


class NamedLine(msgspec.Struct, frozen=True):
    """A name as written, `${prefix}` included, with its 1-based line and the tests around it, outer ones first."""

    name: str
    line: int
    tests: tuple[Guard, ...] = ()


class NamedArgument(NamedLine, frozen=True):
    """What `<xacro:arg>` lets people give on the command line, with its default as written; None where it has none."""

    default: str | None = None


class _Placed(msgspec.Struct, frozen=True):
    """An element with its tag and the tests around it."""

    tag: str
    element: etree._Element
    tests: tuple[Guard, ...] = ()


class RobotNames(msgspec.Struct, frozen=True):
    """What one file has.

    Attributes:
        links: that it declares. commands: `joint/interface` of its hardware.
        parents: links that its joints name, whoever declares them. includes: files, as written.
        arguments: of xacro, which whoever expands the file may give.
    """

    links: tuple[NamedLine, ...] = ()
    commands: tuple[NamedLine, ...] = ()
    parents: tuple[NamedLine, ...] = ()
    includes: tuple[NamedLine, ...] = ()
    arguments: tuple[NamedArgument, ...] = ()


def is_whole_robot(data: bytes) -> bool:
    """Tell whether a file holds a robot and defines no macros for others; one that is refused may be a robot."""
    tree = parse_xml(data)
    if tree.root is None:
        return any(each.cut for each in tree.diagnostics)
    return local_name(tree.root) == _ROBOT and all(local_name(each) != _MACRO for each in tree.root.iter(etree.Element))


def parse_robot_names(data: bytes) -> Parsed[RobotNames]:
    """Read a URDF or xacro file."""
    tree = parse_xml(data)
    if tree.root is None or local_name(tree.root) != "robot":
        return Parsed(RobotNames(), tree.diagnostics)
    placed = list(_placed(tree.root))[:MAX_NAMES]
    names = RobotNames(
        links=tuple(_named(each, "name") for each in placed if each.tag == "link" and each.element.get("name")),
        commands=tuple(entry for each in placed if each.tag == "ros2_control" for entry in _commands(each)),
        parents=tuple(entry for each in placed if each.tag == "joint" for entry in _ends(each)),
        includes=tuple(_named(each, "filename") for each in placed if each.tag == "include"),
        arguments=tuple(_argument(each) for each in placed if each.tag == "arg" and each.element.get("name")),
    )
    return Parsed(names, tree.diagnostics)


def _placed(element: etree._Element, tests: tuple[Guard, ...] = ()) -> Iterator[_Placed]:
    for tag, child in children(element):
        yield _Placed(tag, child, tests)
        if tag in _AROUND:
            yield from _placed(child, _inside(tag, child, tests))


def _inside(tag: str, element: etree._Element, tests: tuple[Guard, ...]) -> tuple[Guard, ...]:
    """The tests around what stands in an element."""
    return (*tests, Guard(str(element.get("value", "")), tag == "unless")) if tag in _TESTS else tests


def _named(placed: _Placed, attribute: str) -> NamedLine:
    return NamedLine(str(placed.element.get(attribute, "")), line_of(placed.element), placed.tests)


def _argument(placed: _Placed) -> NamedArgument:
    at, default = _named(placed, "name"), placed.element.get("default")
    return NamedArgument(at.name, at.line, at.tests, None if default is None else str(default))


def _commands(hardware: _Placed) -> Iterator[NamedLine]:
    for below in _parts(hardware):
        for tag, command in children(below.element):
            part = below.element.get("name")
            if tag == "command_interface" and part and command.get("name"):
                yield NamedLine(f"{part}/{command.get('name')}", line_of(command), below.tests)


def _parts(placed: _Placed) -> Iterator[_Placed]:
    """An element and all below it."""
    yield placed
    for tag, child in children(placed.element):
        yield from _parts(_Placed(tag, child, _inside(placed.tag, placed.element, placed.tests)))


def _ends(joint: _Placed) -> Iterator[NamedLine]:
    for tag, element in children(joint.element):
        if tag in {"parent", "child"} and element.get("link"):
            yield _named(_Placed(tag, element, joint.tests), "link")
