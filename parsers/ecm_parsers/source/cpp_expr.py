"""C++ expressions from tree-sitter nodes.

One small function per node type, found by its name in a table. Lambdas are handed to `Reader.inline`,
since what happens in a callback happens in the module that wrote it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from ecm_parsers.numbers import truncated
from ecm_parsers.source.cpp_brought import Brought
from ecm_parsers.source.cpp_cast_objects import object_cast
from ecm_parsers.source.cpp_casts import cast_arguments
from ecm_parsers.source.cpp_containers import given
from ecm_parsers.source.cpp_effects import has_call
from ecm_parsers.source.cpp_invoking import gets_values, invoked, invoked_by_element
from ecm_parsers.source.cpp_literals import concatenated, constant, number, string, user_literal
from ecm_parsers.source.cpp_names import called_lambda, plain_name, specialized
from ecm_parsers.source.cpp_spacing import collapsed
from ecm_parsers.source.expr import (
    MOVED,
    THIS,
    Call,
    Expr,
    Items,
    Lambda,
    Member,
    Name,
    Number,
    Op,
    Opaque,
    Specialized,
)

if TYPE_CHECKING:
    from tree_sitter import Node

MAX_DEPTH = 60
_CASTS = frozenset({"static_cast", "dynamic_cast", "const_cast", "reinterpret_cast", MOVED.text, "std::forward"})


class ExprReader:
    """Turns expression nodes of one file into `Expr`.

    Attributes:
        data: the bytes that the nodes point into.
        inline: called with each lambda that has a body, on the way.
        called: called with each lambda that is called where it stands; gives the function that it is read as.
        handed: called with every other one; gives what it is where it is read as a function as well.
        own: variables that are the object at hand by another name. brought: names that blocks take from namespaces.
        moved, invoked: variables that were moved from, and what calls make somebody call, since somebody emptied them.
        changed: called with what changes a variable; gives what the expression gets, None for no change within one.
    """

    def __init__(
        self,
        data: bytes,
        inline: Callable[[Node], None],
        called: Callable[[Node], str] | None = None,
        handed: Callable[[Node], Lambda | None] | None = None,
        changed: Callable[[ExprReader, Node], Expr | None] | None = None,
    ) -> None:
        self.data = data
        self.inline = inline
        self.called = called
        self.handed = handed
        self.changed = changed
        self.own: set[str] = set()
        self.brought = Brought()
        self.moved: list[Name] = []
        self.invoked: list[Call] = []
        self._depth = 0

    def text(self, node: Node) -> str:
        """Return the source text of a node."""
        return self.data[node.start_byte : node.end_byte].decode("utf-8", "replace")

    def type_text(self, node: Node) -> str:
        """Return a type as written, white space collapsed."""
        return collapsed(self.text(node))

    def read(self, node: Node) -> Expr:
        """Return the expression at `node`; beyond `MAX_DEPTH` levels it is opaque."""
        reader = _READERS.get(node.type)
        if reader is None or self._depth >= MAX_DEPTH:
            return Opaque(self.text(node)[:80])
        self._depth += 1
        try:
            return reader(self, node)
        finally:
            self._depth -= 1

    @contextmanager
    def before(self) -> Iterator[None]:
        """Read what becomes statements before the one at hand: what that moves from is moved behind it."""
        around = self.moved[:], self.invoked[:]
        self.moved.clear()
        self.invoked.clear()
        yield
        self.moved[:0], self.invoked[:0] = around

    def made(self, call: Call) -> Call:
        """Return a call that was read; what it makes somebody call is a statement behind the one at hand."""
        called = invoked(call) or invoked_by_element(call)
        if called is not None:
            self.invoked.append(called)
        return call

    def arguments(self, node: Node | None) -> tuple[Expr, ...]:
        """Return the expressions of an argument or initialiser list."""
        if node is None:
            return ()
        return tuple([self.read(child) for child in node.named_children if child.type != "comment"])

    def name(self, node: Node) -> str:
        """Return a possibly qualified name without template arguments."""
        if node.type == "qualified_identifier":
            scope, last = node.child_by_field_name("scope"), node.child_by_field_name("name")
            head = self.name(scope) if scope is not None else ""
            return f"{head}::{self.name(last)}" if last is not None else head
        if node.type in _TEMPLATED:
            inner = node.child_by_field_name("name")
            return self.name(inner) if inner is not None else self.text(node)
        if node.type == "dependent_name":
            return self.name(node.named_children[-1]) if node.named_children else ""
        return self.text(node)

    def template_arguments(self, node: Node | None) -> tuple[str, ...]:
        """Return the template arguments of the last name of a callee that has some, as written."""
        scope = None
        while node is not None and node.type in {
            "qualified_identifier",
            "field_expression",
            "dependent_name",
        }:
            scope = node.child_by_field_name("scope") or scope
            following = node.child_by_field_name("name") or node.child_by_field_name("field")
            node = following or (node.named_children[-1] if node.named_children else None)
        if node is None or node.type not in _TEMPLATED:
            node = scope
        if node is None or node.type not in _TEMPLATED:
            return ()
        listed = node.child_by_field_name("arguments")
        if listed is None:
            return ()
        return tuple([self.type_text(child) for child in listed.named_children if child.type != "comment"])


_TEMPLATED = frozenset({"template_function", "template_type", "template_method"})


def _field(reader: ExprReader, node: Node) -> Expr:
    base, field = node.child_by_field_name("argument"), node.child_by_field_name("field")
    if base is None or field is None:
        return Opaque(reader.text(node)[:80])
    if any(child.type == ".*" for child in node.children):  # a member that a pointer chooses is known when it runs
        return Op("[]", (object_cast(reader, base), Name(reader.name(field))))
    return Member(object_cast(reader, base), reader.name(field))


def _call(reader: ExprReader, node: Node) -> Expr:
    function, listed = node.child_by_field_name("function"), node.child_by_field_name("arguments")
    if function is None:
        return Opaque(reader.text(node)[:80])
    if function.type in {"identifier", "template_function", "qualified_identifier"}:
        name = reader.name(function)
        if name in _CASTS and listed is not None and listed.named_child_count == 1:
            value = reader.read(listed.named_children[0])
            if name == MOVED.text and isinstance(value, Name):
                reader.moved.append(value)
            return _cast(value, reader.template_arguments(function))
    callee = called_lambda(reader, function) or reader.read(function)
    callee = Name(callee.id) if isinstance(callee, Specialized) else callee
    last = function.child_by_field_name("field") or function.child_by_field_name("name") or function
    types = reader.template_arguments(function)
    return reader.made(Call(callee, cast_arguments(reader, listed), (), types, last.start_point[0] + 1))


def _cast(value: Expr, types: tuple[str, ...]) -> Expr:
    """A cast changes nothing but numbers: `static_cast<double>(10)` is 10.0."""
    if isinstance(value, Number) and types in {("double",), ("float",)}:
        return Number(float(value.value))
    whole = truncated(value.value) if isinstance(value, Number) and types == ("int",) else None
    return Number(whole) if whole is not None else value


def _object(reader: ExprReader, node: Node) -> Expr:
    """`new T(x)`, `T{x}`."""
    made = node.child_by_field_name("type")
    if made is None:
        return Opaque(reader.text(node)[:80])
    listed = node.child_by_field_name("arguments") or node.child_by_field_name("value")
    name, braces = reader.name(made), listed is not None and listed.type == "initializer_list"
    args = given(name, reader.arguments(listed), braces)
    return reader.made(Call(Name(name), args, (), reader.template_arguments(made), made.start_point[0] + 1))


def _binary(reader: ExprReader, node: Node) -> Expr:
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    operator = node.child_by_field_name("operator")
    if left is None or right is None or operator is None:
        return Opaque(reader.text(node)[:80])
    return Op(operator.type, (reader.read(left), reader.read(right)))


def _assignment(reader: ExprReader, node: Node) -> Expr:
    changed = _changed(reader, node)
    return _binary(reader, node) if changed is None else changed


def _changed(reader: ExprReader, node: Node) -> Expr | None:
    """What an expression gets of a part that changes a variable; None of a part that does not."""
    with reader.before():
        return reader.changed(reader, node) if reader.changed is not None else None


def _update(reader: ExprReader, node: Node) -> Expr:
    changed = _changed(reader, node)
    return Opaque(reader.text(node)[:80]) if changed is None else changed


def _unary(reader: ExprReader, node: Node) -> Expr:
    operator, argument = node.child_by_field_name("operator"), node.child_by_field_name("argument")
    if operator is None or argument is None:
        return Opaque(reader.text(node)[:80])
    value = reader.read(argument)
    if operator.type == "*":
        return value
    if operator.type == "-" and isinstance(value, Number):
        return Number(-value.value)
    return Op(operator.type, (value,))


def _conditional(reader: ExprReader, node: Node) -> Expr:
    parts = (node.child_by_field_name(field) for field in ("condition", "consequence", "alternative"))
    read = tuple([reader.read(part) for part in parts if part is not None])
    return Op("?:", read) if len(read) == 3 else Opaque(reader.text(node)[:80])


def _subscript(reader: ExprReader, node: Node) -> Expr:
    base, indices = node.child_by_field_name("argument"), node.child_by_field_name("indices")
    if base is None or indices is None or not indices.named_children:
        return Opaque(reader.text(node)[:80])
    return Op("[]", (reader.read(base), reader.read(indices.named_children[0])))


def _items(reader: ExprReader, node: Node) -> Expr:
    return Items(reader.arguments(node))


def _deleted(reader: ExprReader, node: Node) -> Expr:
    """`delete f()` calls what gives it the object."""
    return Op("delete", tuple([reader.read(child) for child in node.named_children if child.type != "comment"]))


def _inner(reader: ExprReader, node: Node) -> Expr:
    value = node.child_by_field_name("value") or (node.named_children[0] if node.named_children else None)
    return reader.read(value) if value is not None else Opaque("")


def _last(reader: ExprReader, node: Node) -> Expr:
    """`(a, b)` is `b`; what calls in `a` do is done before."""
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    if left is None or right is None:
        return Opaque("")
    before, last = reader.read(left), reader.read(right)
    return Op(",", (before, last)) if has_call(before) else last


def _lambda(reader: ExprReader, node: Node) -> Expr:
    called = called_lambda(reader, node) if gets_values(reader, node) else None
    if called is not None:
        return called
    if node.child_by_field_name("body") is not None:
        with reader.before():
            handed = reader.handed(node) if reader.handed is not None else None
            if handed is not None:
                return handed
            reader.inline(node)
    return Lambda(lambda_types(reader, node))


def lambda_types(reader: ExprReader, node: Node) -> tuple[str, ...]:
    """Return the parameter types of a lambda, as written."""
    declarator = node.child_by_field_name("declarator")
    listed = declarator.child_by_field_name("parameters") if declarator is not None else None
    if listed is None:
        return ()
    kinds = (child.child_by_field_name("type") for child in listed.named_children)
    return tuple([reader.type_text(kind) for kind in kinds if kind is not None])


def _designated(reader: ExprReader, node: Node) -> Expr:
    """`.field = value` among the values of a structure."""
    field, value = node.child_by_field_name("designator"), node.child_by_field_name("value")
    if field is None or field.type != "field_designator" or value is None:
        return Opaque(reader.text(node)[:80])
    return Op(".=", (Name(reader.text(field).lstrip(". ")), reader.read(value)))


_READERS: dict[str, Callable[[ExprReader, Node], Expr]] = {
    "string_literal": string,
    "raw_string_literal": string,
    "char_literal": string,
    "concatenated_string": concatenated,
    "number_literal": number,
    "user_defined_literal": user_literal,
    "true": constant,
    "false": constant,
    "null": constant,
    "nullptr": constant,
    "this": lambda reader, node: THIS,
    "identifier": plain_name,
    "field_identifier": plain_name,
    "type_identifier": plain_name,
    "namespace_identifier": plain_name,
    "qualified_identifier": specialized,
    "template_function": specialized,
    "template_type": plain_name,
    "primitive_type": plain_name,
    "dependent_name": plain_name,
    "field_expression": _field,
    "call_expression": _call,
    "new_expression": _object,
    "compound_literal_expression": _object,
    "binary_expression": _binary,
    "assignment_expression": _assignment,
    "update_expression": _update,
    "unary_expression": _unary,
    "pointer_expression": _unary,
    "conditional_expression": _conditional,
    "subscript_expression": _subscript,
    "initializer_list": _items,
    "initializer_pair": _designated,
    "parenthesized_expression": _inner,
    "condition_clause": _inner,
    "cast_expression": _inner,
    "co_await_expression": _inner,
    "comma_expression": _last,
    "delete_expression": _deleted,
    "lambda_expression": _lambda,
}
