"""The namespaces that a definition of C++ opens: `namespace a::b {`, `inline namespace v1 {`, `namespace {`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from tree_sitter import Node


class Opened(NamedTuple):
    """One of them: its name, empty for an anonymous one, and whether it is inline."""

    name: str
    inline: bool


def opened(node: Node) -> Iterator[Opened]:
    """Yield those of a definition, outermost first.

    Source: C++, [namespace.def]: what an inline namespace declares, the one around it has as well.
    """
    named = list(_named(node))
    yield from named or (Opened("", inline=False),)


def _named(node: Node) -> Iterator[Opened]:
    inline = False
    for child in node.children:
        if child.type == "nested_namespace_specifier":
            yield from _named(child)
        elif child.type == "namespace_identifier" and child.text is not None:
            yield Opened(child.text.decode(errors="replace"), inline)
            inline = False
        inline = inline or child.type == "inline"
