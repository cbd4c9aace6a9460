"""What reads as a function without being one: `QoS qos(QoS::from(profile));` and `on && go();` in a body, macros."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.expr import Call, Constant, Expr, Name, Op

if TYPE_CHECKING:
    from tree_sitter import Node


_CONSTANTS: Final[Mapping[str, Constant]] = {
    "true": Constant("true"),
    "false": Constant("false"),
    "nullptr": Constant("null"),
}
"""Words that the grammar takes for types where it reads a function."""


def as_arguments(reader: ExprReader, listed: Node) -> tuple[Expr, ...] | None:
    """Return the arguments that a list of parameters without names means: `a`, `a[1]`, `A::make(b)`."""
    args: list[Expr] = []
    for child in listed.named_children:
        arg = _argument(reader, child)
        if arg is None:
            return None
        args.append(arg)
    return tuple(args)


def _argument(reader: ExprReader, child: Node) -> Expr | None:
    """Return what one parameter without a name means; None for one that is no expression."""
    written, declarator = child.child_by_field_name("type"), child.child_by_field_name("declarator")
    if written is None:
        return None
    name: Expr = Name(reader.name(written))
    if declarator is None:
        return _CONSTANTS.get(reader.name(written), name)
    if len(declarator.named_children) != 1:
        return None
    size, inner = declarator.child_by_field_name("size"), declarator.child_by_field_name("parameters")
    if declarator.type == "abstract_array_declarator" and size is not None:
        return Op("[]", (name, reader.read(size)))
    given = as_arguments(reader, inner) if declarator.type == "abstract_function_declarator" and inner else None
    if given is None:
        return None
    return Call(name, given, (), reader.template_arguments(written), child.start_point[0] + 1)


def as_choice(reader: ExprReader, kind: Node, declarator: Node) -> Expr | None:
    """Return what `ready && load(x);` means in a body, which reads as a function of a type `ready`; None of others."""
    inner = declarator.named_children[0] if len(declarator.named_children) == 1 else None
    if declarator.type != "reference_declarator" or declarator.children[0].type != "&&" or inner is None:
        return None
    named, listed = inner.child_by_field_name("declarator"), inner.child_by_field_name("parameters")
    if kind.type != "type_identifier" or named is None or listed is None or named.type != "identifier":
        return None
    args = as_arguments(reader, listed)
    if args is None:
        return None
    return Op("&&", (Name(reader.text(kind)), Call(Name(reader.text(named)), args, (), (), inner.start_point[0] + 1)))


def is_call_of_macro(node: Node, scope: str, name: str) -> bool:
    """Whether a declaration is a macro with its arguments.

    Of functions, only those that make, end or convert an object have no type.
    """
    if node.child_by_field_name("type") is not None or node.child_by_field_name("body") is not None:
        return False
    own = scope.rpartition("::")[2].partition("<")[0]
    return name != own and not name.startswith(("~", "operator"))


def loop_macro(reader: ExprReader, declarator: Node) -> tuple[Node, Expr] | None:
    """Return (what is bound, the list) of a macro like `BOOST_FOREACH(const T & item, list)`."""
    name, listed = declarator.child_by_field_name("declarator"), declarator.child_by_field_name("parameters")
    if name is None or listed is None or "foreach" not in reader.text(name).lower():
        return None
    given = listed.named_children
    bound = given[0].child_by_field_name("declarator") if len(given) == 2 else None
    over = _argument(reader, given[1]) if bound is not None else None
    return (bound, over) if bound is not None and over is not None else None
