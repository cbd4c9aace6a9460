"""Lambdas of C++: what they are given, and which of those that are handed on are read as functions of their own.

One that is handed to a function which the same file declares is read so, as one that gets a name is: who calls it can
be seen. What others call is part of the body around it, to be run later.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.cpp_declarators import trailing_reference
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_parameters import declared_name, parameters
from ecm_parsers.source.expr import Call, Expr, Lambda
from ecm_parsers.source.facts import Function, Parameter

if TYPE_CHECKING:
    from tree_sitter import Node

_APART: Final = frozenset({"compound_statement", "parameter_list"})
"""What is within declares no function that others can call by its name."""


class DeclaredFunctions:
    """The functions that a file declares, by their last names; looked for once somebody asks."""

    def __init__(self, data: bytes) -> None:
        self._reader = ExprReader(data, lambda body: None)
        self._names: Set[str] | None = None

    def get(self, argument: Node) -> bool:
        """Tell whether a lambda is an argument of a call of one of them, on no other object than the one at hand."""
        listed = argument.parent
        call = listed.parent if listed is not None and listed.type == "argument_list" else None
        callee = call.child_by_field_name("function") if call is not None else None
        name = self._called(callee) if callee is not None else ""
        return bool(name) and name in self._all(argument)

    def _called(self, callee: Node) -> str:
        """The name of a function, or of a method of the object at hand; empty for other callees."""
        if callee.type == "field_expression":
            owner, field = callee.child_by_field_name("argument"), callee.child_by_field_name("field")
            return self._reader.name(field) if owner is not None and field is not None and owner.type == "this" else ""
        plain = callee.type in {"identifier", "template_function", "qualified_identifier"}
        return self._reader.name(callee).rpartition("::")[2] if plain else ""

    def _all(self, within: Node) -> Set[str]:
        if self._names is None:
            root = within
            while root.parent is not None:
                root = root.parent
            self._names = frozenset(self._declared(root))
        return self._names

    def _declared(self, root: Node) -> Iterator[str]:
        pending = [root]
        while pending:
            node = pending.pop()
            if node.type == "function_declarator":
                yield declared_name(self._reader, node).rpartition("::")[2]
            elif node.type not in _APART:
                pending += node.named_children


def place_name(node: Node) -> str:
    """Return what a lambda without a name is called as a function: where it stands."""
    row, column = node.start_point
    return f"<lambda {row + 1}:{column + 1}>"


def lambda_parameters(reader: ExprReader, node: Node) -> tuple[Parameter, ...]:
    """Return the parameters of a lambda."""
    declarator = node.child_by_field_name("declarator")
    return parameters(reader, declarator.child_by_field_name("parameters") if declarator is not None else None)


def lambda_traits(node: Node) -> tuple[str, ...]:
    """Return the traits of a lambda: what it returns, and whether it changes copies that it has."""
    copies = ("mutable",) if _changes_copies(node) else ()
    return ("lambda", *copies, *trailing_reference(node.child_by_field_name("declarator")))


def _changes_copies(node: Node) -> bool:
    """Whether a lambda may change its own copies of variables around it, which go by the names of these."""
    declarator = node.child_by_field_name("declarator")
    parts = declarator.children if declarator is not None else []
    if not any(part.text == b"mutable" for part in parts):
        return False
    listed = node.child_by_field_name("captures")
    return listed is not None and any(map(_is_copied, listed.named_children))


def _is_copied(capture: Node) -> bool:
    """Whether a lambda has copies by a capture that gives them no value: `=`, `name`, `*this`, `names...`."""
    if capture.type == "lambda_default_capture":
        return capture.text == b"="
    before = capture.prev_sibling.type if capture.prev_sibling is not None else ""
    if capture.type == "this":
        return before == "*"
    return capture.type != "lambda_capture_initializer" and before != "&"


def as_function(types: tuple[str, ...], made: Function) -> Lambda:
    """Return the lambda, of parameters of some types, that is read as a function."""
    return Lambda(types, tuple([parameter.name for parameter in made.params]), _only_expression(made), made.name)


def _only_expression(made: Function) -> Expr | None:
    """What a lambda returns, or calls, that does nothing else; None of others."""
    first = made.body[0] if len(made.body) == 1 else None
    plain = first is not None and (first.kind == "return" or (first.kind == "do" and isinstance(first.value, Call)))
    return first.value if first is not None and plain else None
