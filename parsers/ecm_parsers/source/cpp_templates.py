"""Parameters of templates: their names, and what they are where nobody says it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_expr import ExprReader

if TYPE_CHECKING:
    from tree_sitter import Node


def is_variadic(listed: Node | None) -> bool:
    """Tell whether one of the parameters of a template is a pack, which takes as many arguments as there are."""
    params = listed.named_children if listed is not None else []
    return any(b"..." in (child.text or b"") for child in params)


def template_parameters(reader: ExprReader, listed: Node | None) -> tuple[tuple[str, ...], tuple[tuple[str, str], ...]]:
    """Return the names of the parameters of a template, and the name and default of each type that has one."""
    params = listed.named_children if listed is not None else []
    given = ((_name(reader, child), child.child_by_field_name("default_type")) for child in params)
    defaults = [(name, reader.type_text(kind)) for name, kind in given if kind is not None]
    return tuple([_name(reader, child) for child in params]), tuple(defaults)


def _name(reader: ExprReader, node: Node) -> str:
    words = reader.text(node).split("=")[0].replace("...", " ").split()
    return words[-1] if words else ""
