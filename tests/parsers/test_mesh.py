"""How large a mesh is drawn: units, nodes, formats, and content of any kind."""

from __future__ import annotations

import struct
import time

import pytest
from ecm_parsers.mesh import mesh_extent
from hypothesis import given, settings
from hypothesis import strategies as st

COLLADA = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>{unit}</asset>
  <library_geometries><geometry id="g"><mesh>
    <source id="n"><float_array count="3">900 900 900</float_array></source>
    <source id="p"><float_array count="6">0 0 0 2 4 1</float_array></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene><node>{transform}{inner}</node></visual_scene></library_visual_scenes>
  <library_physics_models><physics_model><instance_geometry url="#g"/></physics_model></library_physics_models>
</COLLADA>"""
INSTANCE = '<instance_geometry url="#g"/>'
MATRIX = "<matrix>0 -0.5 0 9 0.5 0 0 9 0 0 0.5 9 0 0 0 1</matrix>"


@pytest.mark.parametrize(
    ("unit", "transform", "inner", "extent"),
    [
        ("", "", INSTANCE, 4.0),
        ('<unit meter="0.01" name="centimeter"/>', "", INSTANCE, 0.04),
        ('<unit meter="1.0"/>', "<scale>0.001 0.001 0.001</scale>", INSTANCE, 0.004),
        ("", MATRIX, INSTANCE, 2.0),
        ("", "<scale>2 2 2</scale>", f"<node><scale>3 3 3</scale>{INSTANCE}</node>", 24.0),
        ('<unit meter="nought"/>', "", INSTANCE, 4.0),
        ("", "", "", 4.0),
    ],
    ids=["plain", "unit", "scale", "matrix", "nested", "bad unit", "not drawn"],
)
def test_collada(unit: str, transform: str, inner: str, extent: float) -> None:
    """Positions count, not normals; the unit and the scales of all nodes around a geometry do too."""
    data = COLLADA.format(unit=unit, transform=transform, inner=inner).encode()
    assert mesh_extent("a/b.DAE", data) == pytest.approx(extent)


def binary(*triangles: tuple[float, ...], header: bytes = b"") -> bytes:
    body = b"".join(struct.pack("<12fH", 0, 0, 1, *points, 0) for points in triangles)
    return header.ljust(80, b"\0") + struct.pack("<I", len(triangles)) + body


@pytest.mark.parametrize("header", [b"", b"solid of a careless exporter"])
def test_binary_stl(header: bytes) -> None:
    assert mesh_extent("b.stl", binary((0, 0, 0, 3, 0, 0, 0, -2, 0), header=header)) == pytest.approx(3.0)


def test_text_stl() -> None:
    text = b"solid a\n facet normal 0 0 1\n outer loop\n vertex -1 0 0\n vertex 1.5e0 0 0\n vertex 0 1 0\n endloop\n"
    assert mesh_extent("b.STL", text) == pytest.approx(2.5)


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("b.stl", b""),
        ("b.dae", b""),
        ("b.dae", b"<COLLADA/>"),
        ("b.stl", b"solid\n"),
        ("b.obj", b"v 1 2 3"),
        ("b", b""),
    ],
)
def test_without_size_there_is_none(name: str, data: bytes) -> None:
    assert mesh_extent(name, data) is None


def test_a_count_beyond_the_file_is_no_binary_file() -> None:
    assert mesh_extent("b.stl", b"\0" * 80 + struct.pack("<I", 2**32 - 1) + b"\0" * 50) is None


@settings(max_examples=150)
@given(st.binary(max_size=400), st.sampled_from(["a.stl", "a.dae"]))
def test_any_content(data: bytes, name: str) -> None:
    """A size or none, never an error."""
    extent = mesh_extent(name, data)
    assert extent is None or extent > 0


def test_entities_and_depth_cost_nothing() -> None:
    """Hostile XML: no expansion, no recursion."""
    bomb = b'<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "' + b"&a;" * 1000 + b'">]><COLLADA>&b;</COLLADA>'
    deep = b"<COLLADA>" + b"<node>" * 10_000 + b"</node>" * 10_000 + b"</COLLADA>"
    started = time.process_time()
    assert mesh_extent("a.dae", bomb) is None
    assert mesh_extent("a.dae", deep) is None
    assert time.process_time() - started < 1
