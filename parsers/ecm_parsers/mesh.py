"""Meshes: how large a COLLADA or STL file is, as a viewer that honors units draws it.

Sources: COLLADA 1.4.1 specification (asset, source, visual_scene); STL as binary and as text, whose units are meters
by the convention of URDF.
"""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Iterable, Iterator
from typing import Final

from lxml import etree

from ecm_parsers.xml_tree import local_name, parse_xml

MAX_TRIANGLES: Final = 400_000

_TRIANGLE: Final = struct.Struct("<12fH")
_HEADER: Final = 84
_VERTEX: Final = re.compile(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)")
_Point = tuple[float, float, float]


def mesh_extent(name: str, data: bytes) -> float | None:
    """Longest side of the box around a mesh, in meters.

    Args:
        name: of the file, whose ending tells the format.
        data: its content.

    Returns:
        None for other formats, for what cannot be read, and for a mesh without size.
    """
    ending = name.lower().rpartition(".")[2]
    extent = _of_stl(data) if ending == "stl" else _of_collada(data) if ending == "dae" else None
    return extent if extent is not None and 0 < extent < math.inf else None


# --- STL -------------------------------------------------------------------------------------------------


def _of_stl(data: bytes) -> float | None:
    return _side(_binary_points(data) if _is_binary(data) else _text_points(data))


def _is_binary(data: bytes) -> bool:
    """The length tells: headers of binary files may begin with `solid` too."""
    if len(data) < _HEADER:
        return False
    count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
    return len(data) >= _HEADER + count * _TRIANGLE.size and (count > 0 or not data.lstrip().startswith(b"solid"))


def _binary_points(data: bytes) -> Iterator[_Point]:
    count = min(int.from_bytes(data[_HEADER - 4 : _HEADER], "little"), MAX_TRIANGLES)
    for at in range(count):
        values = _TRIANGLE.unpack_from(data, _HEADER + at * _TRIANGLE.size)
        yield values[3], values[4], values[5]
        yield values[6], values[7], values[8]
        yield values[9], values[10], values[11]


def _text_points(data: bytes) -> Iterator[_Point]:
    for at, match in enumerate(_VERTEX.finditer(data)):
        x, y, z = (_number(part) for part in match.groups())
        if at >= MAX_TRIANGLES * 3 or x is None or y is None or z is None:
            return
        yield x, y, z


# --- COLLADA ---------------------------------------------------------------------------------------------


def _of_collada(data: bytes) -> float | None:
    root = parse_xml(data).root
    if root is None:
        return None
    sizes = {name: side for name, side in _geometries(root) if side is not None}
    drawn = [sizes[name] * scale for name, scale in _instances(root) if name in sizes]
    largest = max(drawn or sizes.values(), default=None)
    return None if largest is None else largest * _unit(root)


def _unit(root: etree._Element) -> float:
    """Meters of one unit; 1 where the file does not say."""
    for element in _below(root, "unit"):
        meters = _number((element.get("meter") or "").encode())
        if meters is not None and meters > 0:
            return meters
    return 1.0


def _geometries(root: etree._Element) -> Iterator[tuple[str, float | None]]:
    for geometry in _below(root, "geometry"):
        inputs = [each for vertices in _below(geometry, "vertices") for each in _below(vertices, "input")]
        wanted = {(each.get("source") or "").lstrip("#") for each in inputs if each.get("semantic") == "POSITION"}
        points: list[_Point] = []
        for source in _below(geometry, "source"):
            if source.get("id") in wanted:
                points += _floats(source)
        yield geometry.get("id") or "", _side(points)


def _floats(source: etree._Element) -> list[_Point]:
    for array in _below(source, "float_array"):
        values = [_number(word.encode()) for word in (array.text or "").split()]
        known = [value for value in values if value is not None]
        return list(zip(known[0::3], known[1::3], known[2::3], strict=False))
    return []


def _instances(root: etree._Element) -> Iterator[tuple[str, float]]:
    """Geometries that nodes draw, with the scale that these give; those of physics models are not drawn."""
    for instance in _below(root, "instance_geometry"):
        above = [each for each in instance.iterancestors() if isinstance(each.tag, str)]
        nodes = [each for each in above if local_name(each) == "node"]
        if nodes:
            yield (instance.get("url") or "").lstrip("#"), math.prod(map(_scale, nodes))


def _scale(node: etree._Element) -> float:
    scale = 1.0
    for child in node:
        if not isinstance(child.tag, str):
            continue
        values = [_number(word.encode()) or 0.0 for word in (child.text or "").split()]
        if local_name(child) == "scale" and len(values) == 3:
            scale *= max(map(abs, values))
        elif local_name(child) == "matrix" and len(values) == 16:
            columns = [values[at : at + 12 : 4] for at in range(3)]
            scale *= max(math.hypot(*column) for column in columns)
    return scale


def _below(element: etree._Element, name: str) -> Iterator[etree._Element]:
    return (each for each in element.iter() if isinstance(each.tag, str) and local_name(each) == name)


def _side(points: Iterable[_Point]) -> float | None:
    low, high = [math.inf] * 3, [-math.inf] * 3
    for point in points:
        for axis, value in enumerate(point):
            low[axis], high[axis] = min(low[axis], value), max(high[axis], value)
    side = max(top - bottom for top, bottom in zip(high, low, strict=True))
    return side if math.isfinite(side) else None


def _number(text: bytes) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
