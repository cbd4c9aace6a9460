"""LNT022: a robot description says something twice where it must be said of two things."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.xml_tree import children, line_of
from lxml import etree

from ecm_extract.lint.robot_files import robot_of, root_of
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT022",
    name="description_repeated",
    dimension="resources",
    severity="warning",
    who="config",
    consequence="both are of that one, and the one that was meant has none",
    resolution="name the link or joint that is meant",
)
_SYSTEMATIC = 4
"""So many of one file are no slip: a program wrote each of them twice."""
_NAMES = {"gazebo": "reference", "link": "name", "joint": "name"}


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report siblings of a description that name one link or joint twice; those under conditions are no siblings."""
    for package in workspace.packages:
        for entry in package.root.files:
            if entry.path.endswith((".urdf", ".xacro")) and not is_test_path(entry.path, package.root.path):
                root = root_of(entry.path, workspace)
                found = [each for element in _elements(root) for each in _of(element, entry.path, package.name)]
                yield from found if len(found) < _SYSTEMATIC else ()


def _elements(root: etree._Element | None) -> Iterator[etree._Element]:
    yield from root.iter(etree.Element) if root is not None else ()


def _of(parent: etree._Element, path: str, package: str) -> Iterator[Finding]:
    seen: dict[tuple[str, str, str, str], etree._Element] = {}
    for tag, element in children(parent):
        if tag == "property":
            seen = {key: first for key, first in seen.items() if "${" not in key[1]}  # a name may mean another now
        if tag not in _NAMES or str(element.tag).startswith("{"):
            continue
        name = element.get(_NAMES[tag], "")
        if not name or parent.tag == "transmission" or (tag != "gazebo" and parent.tag not in ("robot", "macro")):
            continue
        for said, attributes in sorted(_said(element)) if tag == "gazebo" else [("", "")]:
            first = seen.setdefault((tag, str(name), said, attributes), element)
            if first is not element:
                what = f" for {said}" if said else ""
                text = f"<{tag}> {name} stands twice{what}"
                evidence = [Evidence(path, line_of(element)), Evidence(path, line_of(first))]
                entity = Entity(tag, str(name), said, robot_of(element))
                refused = "" if tag == "gazebo" else "the reader of URDF refuses the whole description"
                yield RULE.finding(text, entity, package, evidence, certainty="likely", consequence=refused)
                break


def _said(element: etree._Element) -> set[tuple[str, str]]:
    """Return the children by tag and attributes: two sensors of one link have two names."""
    return {(tag, str(sorted(map(str, child.attrib.items())))) for tag, child in children(element)}
