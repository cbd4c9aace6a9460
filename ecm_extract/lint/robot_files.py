"""Robot description files as they are written, before xacro expands them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ecm_parsers.xml_tree import children, line_of, parse_xml
from lxml import etree

from ecm_extract.lint.workspace import Workspace
from ecm_extract.test_code import is_test_path


@dataclass(frozen=True, slots=True)
class WrittenJoint:
    """A joint element with its children by tag, where it stands, and the robot or macro that it is part of."""

    package: str
    path: str
    line: int
    name: str
    kind: str
    parts: dict[str, dict[str, str]]
    robot: str


def written_joints(workspace: Workspace) -> Iterator[WrittenJoint]:
    """Yield the joints of all description files and macros; tests left out."""
    for package in workspace.packages:
        for entry in package.root.files:
            if entry.path.endswith((".urdf", ".xacro")) and not is_test_path(entry.path, package.root.path):
                root = root_of(entry.path, workspace)
                for element in root.iter("joint") if root is not None else ():
                    parts = {tag: _attributes(child) for tag, child in children(element)}
                    own = _attributes(element)
                    name, kind = own.get("name", ""), own.get("type", "")
                    robot = robot_of(element)
                    yield WrittenJoint(package.name, entry.path, line_of(element), name, kind, parts, robot)


def root_of(path: str, workspace: Workspace) -> etree._Element | None:
    """Return the root element of a description as it is written; None when nothing can be read."""
    tree = workspace.files.parsed(path, parse_xml)
    return tree.root if tree is not None else None


def robot_of(element: etree._Element) -> str:
    """Return the name of the macro or robot around an element; a part that another file includes has none."""
    around = (each for each in element.iterancestors() if etree.QName(each).localname in ("macro", "robot"))
    return next((name for each in around if (name := str(each.get("name", "")))), "")


def _attributes(element: etree._Element) -> dict[str, str]:
    return {str(name): str(value) for name, value in element.attrib.items()}
