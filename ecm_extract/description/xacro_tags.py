"""Which elements of a document are xacro's own: by namespace, and without a prefix as early xacro wrote them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ecm_parsers.xml_tree import local_name
from lxml import etree

_EARLY: Mapping[str, frozenset[str]] = MappingProxyType(
    {
        "property": frozenset({"name", "value"}),
        "macro": frozenset({"name"}),
        "include": frozenset({"filename"}),
        "insert_block": frozenset({"name"}),
        "if": frozenset({"value"}),
        "unless": frozenset({"value"}),
        "arg": frozenset({"name", "default"}),
    }
)
"""Elements that early xacro writes without the prefix, and the attributes that tell them from others."""
_URDF = frozenset(
    {"robot", "link", "joint", "origin", "visual", "collision", "inertial", "geometry", "material", "limit", "axis"}
    | {"parent", "child", "mass", "inertia", "mesh", "box", "cylinder", "sphere", "gazebo", "plugin", "sensor"}
    | {"transmission", "actuator", "param", "hardware", "ros2_control"}
)


def is_xacro(name: object) -> bool:
    """Tell whether a tag or attribute name is in the namespace of xacro, or has its prefix without declaring it."""
    text = str(name)
    if text.startswith("{"):
        return "xacro" in text[1:].partition("}")[0].rpartition("/")[2]
    return text.startswith("xacro:")


def is_control(element: etree._Element) -> bool:
    """Tell whether an element is xacro's own, with the prefix or as early xacro writes it."""
    if is_xacro(element.tag):
        return True
    needed = _EARLY.get(local_name(element))
    if needed is None or str(element.tag).startswith("{") or not needed <= set(element.attrib):
        return False
    return any(uri and "xacro" in uri for uri in element.nsmap.values())


def may_call(element: etree._Element) -> bool:
    """Tell whether an element without prefix can be a macro call of early xacro; those of URDF are none."""
    return not str(element.tag).startswith("{") and local_name(element) not in _URDF


def own_attributes(element: etree._Element) -> Iterator[tuple[str, str]]:
    """Yield name and value of the attributes that are not xacro's."""
    for name, value in element.attrib.items():
        if not is_xacro(name):
            yield str(name).rpartition("}")[2], str(value)


def xacro_attribute(element: etree._Element, name: str) -> str:
    """Return an attribute of the namespace of xacro, else the plain one of that name, else nothing."""
    for written, value in element.attrib.items():
        if is_xacro(written) and str(written).rpartition("}")[2].rpartition(":")[2] == name:
            return str(value)
    return str(element.get(name, ""))


def elements(parent: etree._Element) -> list[etree._Element]:
    """Return the child elements without comments."""
    return [child for child in parent if isinstance(child.tag, str)]
