"""Launch XML and YAML as the same light tree, as `launch.frontend.Entity` sees both."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import msgspec
from lxml import etree

from ecm_parsers.xml_tree import children, line_of, text_of
from ecm_parsers.yaml_tree import Mapping, Node, Scalar, Sequence, plain

MAX_DEPTH = 60


class Entity(msgspec.Struct, frozen=True):
    """One element: its tag with `-` as `_`, attributes as text, children and own text, 1-based line.

    `data` holds the attributes of YAML as values, since there a text in quotes is no number.
    """

    tag: str
    attributes: dict[str, str]
    children: tuple[Entity, ...]
    text: str
    line: int
    data: dict[str, Any] = {}

    def get(self, *names: str) -> str | None:
        """Return the first attribute of these names."""
        return next((self.attributes[name] for name in names if name in self.attributes), None)

    def below(self, *tags: str) -> Iterator[Entity]:
        """Yield the children with one of these tags."""
        return (child for child in self.children if child.tag in tags)


def of_xml(element: etree._Element) -> Entity:
    """Return an XML element as an entity; nesting is bounded by `parse_xml`."""
    below = [of_xml(child) for _, child in children(element)]
    return Entity(
        str(element.tag).rpartition("}")[2].replace("-", "_"),
        {str(name): str(value) for name, value in element.attrib.items()},
        tuple(below),
        _around_comments(element) if not below else text_of(element),
        line_of(element),
    )


def _around_comments(element: etree._Element) -> str:
    """Text before, between and after comments; these leave their line ends, so that lines can be counted."""
    parts = [element.text or ""]
    for comment in element:
        parts += ["\n" * str(comment.text or "").count("\n"), comment.tail or ""]
    return "".join(parts)


def of_yaml(tag: str, node: Node, line: int, depth: int = 0) -> Entity:
    """Return a YAML map or list as an entity: scalars are attributes, maps and lists of maps are children."""
    tag = tag.replace("-", "_")
    attributes: dict[str, str] = {}
    data: dict[str, Any] = {}
    below: list[Entity] = []
    text = node.text if isinstance(node, Scalar) else ""
    if isinstance(node, Sequence) and depth < MAX_DEPTH:
        below = list(_items(node, depth))
    for entry in node.entries if isinstance(node, Mapping) and depth < MAX_DEPTH else ():
        if isinstance(entry.value, Scalar):
            attributes[entry.key] = entry.value.text
            data[entry.key] = entry.value.value
        elif isinstance(entry.value, Sequence) and not _are_entities(entry.value):
            below += [of_yaml(entry.key, item, item.line, depth + 1) for item in entry.value.items]
            attributes.setdefault(entry.key, _listed(entry.value))
            data.setdefault(entry.key, plain(entry.value))
        else:
            below.append(of_yaml(entry.key, entry.value, entry.line, depth + 1))
    return Entity(tag, attributes, tuple(below), text, line, data)


def _listed(node: Sequence) -> str:
    """A list of scalars is an attribute with its items separated by commas, as `value-sep` has it."""
    return ", ".join(item.text for item in node.items if isinstance(item, Scalar))


def _items(node: Sequence, depth: int) -> Iterator[Entity]:
    for item in node.items:
        if isinstance(item, Mapping) and len(item.entries) == 1:
            entry = item.entries[0]
            yield of_yaml(entry.key, entry.value, entry.line, depth + 1)


def _are_entities(node: Sequence) -> bool:
    """`children:`-like lists hold maps with one key whose value is no scalar."""
    return bool(node.items) and all(
        isinstance(item, Mapping) and len(item.entries) == 1 and not isinstance(item.entries[0].value, Scalar)
        for item in node.items
    )
