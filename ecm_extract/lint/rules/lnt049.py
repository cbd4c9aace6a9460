"""LNT049: a mesh is drawn many times larger or smaller than the shape that collides in its place."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_parsers.mesh import mesh_extent
from ecm_parsers.xml_tree import line_of
from lxml import etree

from ecm_extract.lint.robot_files import root_of
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT049",
    name="mesh_size_off",
    dimension="signature",
    severity="warning",
    who="safety",
    consequence="what is drawn is not what planners and simulators keep clear of",
    resolution="declare the unit of the mesh (COLLADA <unit>), or scale it where it is used",
    of_sources="sizes of meshes",
)
_MESH: Final = re.compile(r"(?:package://|\$\(find(?:-pkg-share)? )(\w+)\)?/([\w./-]+\.(?:stl|dae))$", re.IGNORECASE)
_TOO_FAR: Final = 10.0
"""Bounding shapes are coarse; units are wrong by 10 and more."""
_DUMMY: Final = 0.01
"""A shape of a centimeter or less is mostly there on purpose: something has to be."""
MAX_MESHES: Final = 80


class Visual(NamedTuple):
    """A mesh of a link, the scale it is drawn with, and its line."""

    package: str
    file: str
    scale: float
    line: int


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report meshes of links whose collision shape is a box, cylinder or sphere with numbers, each file once."""
    sizes: dict[tuple[str, str], float | None] = {}
    seen, left_out = set(), set[str]()
    for package in workspace.packages:
        for entry in package.root.files:
            if not entry.path.endswith((".urdf", ".xacro")) or is_test_path(entry.path, package.root.path):
                continue
            for visual, shape in _links(root_of(entry.path, workspace)):
                key = visual.package, visual.file
                if key not in sizes and len(sizes) >= MAX_MESHES:
                    left_out.add(entry.path)
                elif key not in sizes:
                    sizes[key] = _size(visual, workspace)
                drawn = (sizes.get(key) or 0.0) * visual.scale
                if drawn and not 1 / _TOO_FAR < drawn / shape < _TOO_FAR and key not in seen:
                    seen.add(key)
                    yield _finding(visual, drawn, shape, Evidence(entry.path, visual.line), package.name)
    workspace.leave_out(sorted(left_out), "meshes")


def _finding(visual: Visual, drawn: float, shape: float, place: Evidence, package: str) -> Finding:
    name = visual.file.rpartition("/")[2]
    times = drawn / shape
    text = f"{name} is {drawn:.3g} m long and its collision shape {shape:.3g} m, {times:.3g} times"
    entity = Entity("file", f"{visual.package}/{visual.file}")
    severity: Severity = "info" if shape <= _DUMMY else "warning"
    return RULE.finding(text, entity, package, [place], certainty="likely", severity=severity)


def _size(visual: Visual, workspace: Workspace) -> float | None:
    package = workspace.by_name.get(visual.package)
    if package is None:
        return None
    root = f"{package.root.path}/" if package.root.path else ""
    return workspace.files.parsed(f"{root}{visual.file}", lambda data: mesh_extent(visual.file, data))


def _links(root: etree._Element | None) -> Iterator[tuple[Visual, float]]:
    """The only mesh of each link that has one, with the longest side of its collision shapes."""
    for link in root.iter("link") if root is not None else ():
        shapes = [side for each in link.iter("collision") for side in [_shape(each)] if side is not None]
        visuals = [visual for each in link.iter("visual") for visual in _meshes(each)]
        if shapes and len(visuals) == 1 == len(list(link.iter("visual"))):
            yield visuals[0], max(shapes)


def _meshes(visual: etree._Element) -> Iterator[Visual]:
    for mesh in visual.iter("mesh"):
        match = _MESH.search(mesh.get("filename") or "")
        scale = _numbers(mesh.get("scale") or "1 1 1")
        if match is not None and scale is not None and len(scale) == 3:
            yield Visual(match[1], match[2], max(map(abs, scale)), line_of(mesh))


def _shape(collision: etree._Element) -> float | None:
    """Longest side of a shape in meters; None for meshes and for what is not written in numbers."""
    for box in collision.iter("box"):
        size = _numbers(box.get("size") or "")
        return max(size) if size else None
    for cylinder in collision.iter("cylinder"):
        sizes = _numbers(f"{cylinder.get('length') or 'x'} {cylinder.get('radius') or 'x'}")
        return max(sizes[0], 2 * sizes[1]) if sizes else None
    for sphere in collision.iter("sphere"):
        radius = _numbers(sphere.get("radius") or "")
        return 2 * radius[0] if radius else None
    return None


def _numbers(text: str) -> Sequence[float] | None:
    try:
        found = [float(word) for word in text.split()]
    except ValueError:
        return None
    return found if found and all(value > 0 for value in map(abs, found)) else None
