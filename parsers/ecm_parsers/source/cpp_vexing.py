"""Constructions that read as function declarations: `QoS qos(QoS::from(profile));` in a body makes an object."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.expr import Call, Expr, Name

if TYPE_CHECKING:
    from tree_sitter import Node


def as_arguments(reader: ExprReader, listed: Node) -> tuple[Expr, ...] | None:
    """Return the arguments that a list of parameters without names means: `a`, `A::make(b)`; None for others."""
    args: list[Expr] = []
    for child in listed.named_children:
        written, declarator = child.child_by_field_name("type"), child.child_by_field_name("declarator")
        if written is None:
            return None
        name = Name(reader.name(written))
        if declarator is None:
            args.append(name)
            continue
        inner = declarator.child_by_field_name("parameters")
        if declarator.type != "abstract_function_declarator" or len(declarator.named_children) != 1 or inner is None:
            return None
        given = as_arguments(reader, inner)
        if given is None:
            return None
        args.append(Call(name, given, (), reader.template_arguments(written), child.start_point[0] + 1))
    return tuple(args)
