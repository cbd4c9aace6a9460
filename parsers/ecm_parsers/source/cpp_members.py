"""Members of a class in C++, each with the access that stands above it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_arrays import extents
from ecm_parsers.source.cpp_declarators import announced_end, flat_members, function_declarator, leading_words, lines_of
from ecm_parsers.source.cpp_parameters import declared_name
from ecm_parsers.source.cpp_place import Place
from ecm_parsers.source.facts import OVERLAID, Constant, Field

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_declarations import DeclarationReader

CLASSES = frozenset({"class_specifier", "struct_specifier", "union_specifier"})
_MARKS = {"pointer_declarator": "*", "reference_declarator": "&"}


def members(reader: DeclarationReader, body: Node, place: Place, access: str) -> list[Field]:
    """Read the body of a class: its data members are returned, all else goes to the reader."""
    fields: list[Field] = []
    place.access = access
    for child in flat_members(body):
        if child.type == "access_specifier":
            place.access = _access(reader.expr.text(child)) or place.access
        elif child.type == "field_declaration":
            fields.extend(_field(reader, child, place))
        else:
            reader.read(child, place)
    return fields


def _access(text: str) -> str:
    """`public` or the like; empty where the grammar mends what stands there with a word of its own."""
    return next(iter(text.split()), "")


def _field(reader: DeclarationReader, node: Node, place: Place) -> list[Field]:
    kind = node.child_by_field_name("type")
    if kind is not None and (kind.type in CLASSES or kind.type == "enum_specifier"):
        reader.read(kind, Place(place.scope, place.access, place.anonymous))
    words = leading_words(reader.expr, node)
    fields = []
    for declarator, default in _declared(node):
        function = function_declarator(declarator)
        if function is not None:
            reader.add_function(node, function, place, words)
            continue
        value = reader.initial(default, kind, declarator)
        name = declared_name(reader.expr, declarator)
        written = declared_type(reader, kind, declarator)
        traits = (
            *place.traits(),
            *(word for word in words if word in {"static", "constexpr", "const", "mutable"}),
            *announced_end(reader.expr, node),
            *((OVERLAID,) if _is_overlaid(node) else ()),
        )
        if "static" in traits or "constexpr" in traits:
            reader.constants.append(Constant(name, place.scope, value, lines_of(node)[0], written, traits))
        fields.append(Field(name, written, lines_of(declarator)[0], value, traits))
    return fields


def _is_overlaid(node: Node) -> bool:
    """Whether a field holds something else than it is given: of a union, or some bits of a number ([class.bit])."""
    around = node.parent.parent if node.parent is not None else None
    of_union = around is not None and around.type == "union_specifier"
    return of_union or any(child.type == "bitfield_clause" for child in node.children)


def _declared(node: Node) -> list[tuple[Node, Node | None]]:
    """Each declarator of a field with its own default: `double low = 1.0, high;` gives `high` none."""
    found: list[tuple[Node, Node | None]] = []
    for at, child in enumerate(node.children):
        kind = node.field_name_for_child(at)
        if kind == "declarator":
            found.append((child, None))
        elif kind == "default_value" and found:
            found[-1] = (found[-1][0], child)
    return found


def declared_type(reader: DeclarationReader, kind: Node | None, declarator: Node) -> str:
    """Return the type of a variable as written; of one whose type stands here without a name, its own name."""
    if kind is not None and kind.type in CLASSES and kind.child_by_field_name("body") is not None:
        named = kind.child_by_field_name("name")
        return reader.expr.name(named) if named is not None else declared_name(reader.expr, declarator)
    mark = _MARKS.get(declarator.type, "") + extents(declarator)
    return (reader.expr.type_text(kind) if kind is not None else "") + mark
