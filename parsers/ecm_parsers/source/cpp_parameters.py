"""Parameters of functions, and the names that declarators bind."""

from __future__ import annotations

from string import ascii_letters, digits
from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_spacing import collapsed
from ecm_parsers.source.cpp_text import BRACES
from ecm_parsers.source.expr import Items, Text
from ecm_parsers.source.facts import Parameter

if TYPE_CHECKING:
    from tree_sitter import Node


def parameters(reader: ExprReader, listed: Node | None) -> tuple[Parameter, ...]:
    """Return the parameters of a parameter list with their types as written."""
    found = []
    for child in listed.children if listed is not None else ():
        if child.type == "...":
            found.append(Parameter("", child.type))
        kind = child.child_by_field_name("type")
        if kind is None or reader.text(child) == "void":
            continue
        declarator, default = (
            child.child_by_field_name("declarator"),
            child.child_by_field_name("default_value"),
        )
        name = declared_name(reader, declarator) if declarator is not None else ""
        end = declarator if declarator is not None else default
        written = reader.data[child.start_byte : end.start_byte if end is not None else child.end_byte]
        suffix = _suffix(reader, declarator)
        text = collapsed(written.decode("utf-8", "replace").rstrip(" =")) + suffix
        text += "..." if child.type == "variadic_parameter_declaration" else ""
        value = reader.read(default) if default is not None else None
        if default is not None and default.text == BRACES:
            value = Text("") if text.rstrip(" &").endswith("string") else Items(())
        found.append(Parameter(name, text, value))
    return tuple(found)


def declared_name(reader: ExprReader, node: Node) -> str:
    """Return the name that a declarator binds, through references, pointers and arrays."""
    while node.type not in _NAMES:
        inner = node.child_by_field_name("declarator")
        if inner is None and node.named_children:
            inner = next((c for c in node.named_children if c.type in _NAMES or c.type.endswith("declarator")), None)
        if inner is None:
            return ""
        node = inner
    return reader.name(node)


def specialized(reader: ExprReader, node: Node) -> tuple[str, ...]:
    """Return the template arguments after the name of a function, as `f<int>`; none of what its class is given."""
    while node.type == "qualified_identifier":
        inner = node.child_by_field_name("name")
        if inner is None:
            return ()
        node = inner
    return reader.template_arguments(node) if node.type == "template_function" else ()


_WORD = f"{ascii_letters}{digits}_"
_NAMES = frozenset(
    {
        "identifier",
        "field_identifier",
        "qualified_identifier",
        "type_identifier",
        "destructor_name",
        "operator_name",
    }
    | {"operator_cast", "template_function"}
)


def _pointer(reader: ExprReader, declarator: Node) -> str:
    """The rest of the type of a pointer to a function, without its name: `(*)(int)`, `(Arm::*)(int)`."""
    inner, taken = declarator.child_by_field_name("declarator"), declarator.child_by_field_name("parameters")
    held = reader.text(inner).removesuffix(")").rstrip(_WORD) if inner is not None else ""
    return " ".join(f"{held or '(*'}){reader.text(taken) if taken is not None else ''}".split())


def _suffix(reader: ExprReader, declarator: Node | None) -> str:
    if declarator is None:
        return ""
    if declarator.type == "function_declarator":
        return " " + _pointer(reader, declarator)
    if declarator.type.startswith("abstract_"):
        return " " + reader.text(declarator)
    marks = reader.data[declarator.start_byte : declarator.start_byte + 2].decode("utf-8", "replace")
    return " " + "".join(mark for mark in marks if mark in "&*") if marks[:1] in {"&", "*"} else ""
