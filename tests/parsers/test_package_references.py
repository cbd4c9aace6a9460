"""Packages and files that launch files, descriptions and Python name."""

from __future__ import annotations

import pytest
from ecm_parsers.package_references import parse_references

ROWS = [
    ("<include file='$(find arm)/launch/a.launch'/>", [("arm", "launch/a.launch", "find", 1)]),
    ("\n<arg default='$(find-pkg-share arm)'/>", [("arm", "", "find", 2)]),
    ("<mesh filename='package://arm/meshes/a.stl'/>", [("arm", "meshes/a.stl", "uri", 1)]),
    ("<mesh filename='package://arm/$(arg name).stl'/>", [("arm", "", "uri", 1)]),
    (
        "x = get_package_share_directory('arm')\ny = FindPackageShare( \"base\")",
        [("arm", "", "call", 1), ("base", "", "call", 2)],
    ),
    ('<node pkg="arm" type="a"/>', [("arm", "", "start", 1)]),
    ("Node(package='arm', executable='a')", [("arm", "", "start", 1)]),
    ('<node args="load arm/Driver manager"/>', [("arm", "", "load", 1)]),
    ("<!-- $(find arm)\n -->\n<a b='$(find base)/x'/>", [("base", "x", "find", 3)]),
    ("# $(find arm)\n", []),
    ("$(find )", []),
    ("", []),
]


@pytest.mark.parametrize(("text", "rows"), ROWS)
def test_references(text: str, rows: list[tuple[str, str, str, int]]) -> None:
    """Each form, with the path as far as it is written out; what stands in a comment is named by nobody."""
    found = parse_references(text.encode()).facts
    assert [(each.package, each.path, each.form, each.line) for each in found] == rows


def test_any_bytes() -> None:
    """A file of any content is read."""
    assert parse_references(b"\xff\x00$(find \xff)package://\xe4/").facts == ()
