"""Declarations of C++ in a body: the variables that they bind, with their types as written and what they begin with."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_arrays import array_value, characters, extents
from ecm_parsers.source.cpp_cast_objects import cast_class
from ecm_parsers.source.cpp_containers import given
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_invoking import perhaps_invoked
from ecm_parsers.source.cpp_parameters import declared_name
from ecm_parsers.source.cpp_spacing import collapsed
from ecm_parsers.source.cpp_statements import StatementWriter, line_of
from ecm_parsers.source.cpp_vexing import as_arguments, as_choice
from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name

if TYPE_CHECKING:
    from tree_sitter import Node

_MARKS = {"pointer_declarator": " *", "reference_declarator": " &"}


class Binding:
    """Writes the statements that the declarations of one body are.

    Attributes:
        expr: reads what variables begin with.
        writer: takes the statements.
        named_lambda: called with each lambda that a variable is bound to, and the name of the variable.
        buffers: how many characters the arrays of them have that are declared, by their names.
    """

    def __init__(self, expr: ExprReader, writer: StatementWriter, named_lambda: Callable[[str, Node], None]) -> None:
        self.expr = expr
        self.writer = writer
        self.named_lambda = named_lambda
        self.buffers: dict[str, Expr] = {}

    def bind(self, declaration: Node, declarator: Node) -> None:
        """Read one declarator of a declaration."""
        kind = declaration.child_by_field_name("type")
        value = declarator.child_by_field_name("value")
        if kind is None:
            return
        if declarator.type == "function_declarator":
            self._constructed(kind, declarator)
            return
        choice = as_choice(self.expr, kind, declarator)
        if choice is not None:
            self.writer.add("do", declaration, choice)
            return
        bound = declarator.child_by_field_name("declarator") or declarator
        target = self.bound(bound)
        self.expr.brought.hide(each.id for each in _bound_names(target))
        if isinstance(target, Items):
            written = self.expr.type_text(kind) + _MARKS.get(bound.type, "")
            self.writer.add("let", declarator, self._initial(kind, value), target, written)
            return
        name = declared_name(self.expr, bound)
        if value is not None and value.type == "lambda_expression":
            self.named_lambda(name, value)
            return
        array_of = bound if value is not None else declarator
        if value is not None and _is_own_object(value, bound):
            self.expr.own.add(name)
        size = characters(self.expr, kind, array_of)
        if size is not None:
            self.buffers[name] = size
        array = array_value(self.expr, kind, bound, value) if value is not None else None
        read = array if array is not None else self._initial(kind, value)
        qualifier = _qualifier(self.expr, declaration)
        named = cast_class(self.expr, kind, value) or self.expr.type_text(kind)
        written = qualifier + named + _MARKS.get(bound.type, "") + extents(array_of)
        kept = not qualifier and _is_static(self.expr, declaration)
        self.writer.add("let", declarator, read, Name(name), written, kept)

    def each(self, loop: Node, over: Node, declarator: Node) -> int:
        """Read what a loop binds in each round, and return the index of that statement."""
        kind = loop.child_by_field_name("type")
        value = self.expr.read(over)
        self.expr.brought.hide(each.id for each in _bound_names(self.bound(declarator)))
        mark = _MARKS.get(declarator.type, "")
        written = self._written(loop, kind, declarator) + mark if kind is not None else ""
        return self.writer.apart(loop, value, self.bound(declarator), written)

    def initializer(self, node: Node) -> None:
        """Read what a constructor gives to one member or base; braces stay a list, as the member may be one."""
        target, *rest = node.named_children
        listed = rest[-1] if rest else None
        args = self.expr.arguments(listed)
        types = self.expr.template_arguments(target)
        name = Name(self.expr.name(target))
        base = "::" in name.id or name.id[:1].isupper()
        braces = listed is not None and listed.type == "initializer_list"
        made: Expr = Call(name, args, (), types, line_of(target))
        value = Items(args) if braces and args and not base else made if base or len(args) != 1 else args[0]
        called = perhaps_invoked(Member(THIS, name.id), args, line_of(target)) if not base else None
        self.expr.invoked += [called] if called is not None else []
        self.writer.add("init", target, value, name)

    def bound(self, declarator: Node) -> Expr:
        """Return what a declarator binds: a name, or several of a structured binding."""
        while declarator.type == "reference_declarator" and declarator.named_children:
            declarator = declarator.named_children[0]
        if declarator.type == "structured_binding_declarator":
            return Items(tuple([Name(self.expr.text(child)) for child in declarator.named_children]))
        return Name(declared_name(self.expr, declarator))

    def _written(self, node: Node, kind: Node, declarator: Node) -> str:
        """A declared type with its qualifiers."""
        first = next((child for child in node.children if child.type == "type_qualifier"), kind)
        text = self.expr.data[min(first.start_byte, kind.start_byte) : declarator.start_byte]
        return collapsed(text.decode("utf-8", "replace"))

    def _constructed(self, kind: Node, declarator: Node) -> None:
        """`Listener listener(buffer);` reads as a function declaration; in a body it makes an object."""
        named, listed = (
            declarator.child_by_field_name("declarator"),
            declarator.child_by_field_name("parameters"),
        )
        if named is None or listed is None or named.type != "identifier" or not listed.named_children:
            return
        args = as_arguments(self.expr, listed)
        if args is not None:
            made = self._made(kind, args)
            self.writer.add("let", declarator, made, Name(self.expr.text(named)), self.expr.type_text(kind))

    def _initial(self, kind: Node, value: Node | None) -> Expr | None:
        if value is None:
            return None
        if value.type not in {"argument_list", "initializer_list"}:
            return self.expr.read(value)
        args = self.expr.arguments(value)
        if value.type == "initializer_list" and kind.type == "placeholder_type_specifier":
            return Items(args)
        return self._made(kind, given(self.expr.name(kind), args, value.type == "initializer_list"))

    def _made(self, kind: Node, args: tuple[Expr, ...]) -> Call:
        """The call that makes an object of a type."""
        made = Call(Name(self.expr.name(kind)), args, (), self.expr.template_arguments(kind), line_of(kind))
        return self.expr.made(made)


def _bound_names(target: Expr) -> tuple[Name, ...]:
    """The variables that a declarator declares."""
    items = target.items if isinstance(target, Items) else (target,)
    return tuple([each for each in items if isinstance(each, Name)])


def _is_own_object(value: Node, bound: Node) -> bool:
    """Tell whether a variable is another name of the object at hand: `auto self = this;`, `auto & self = *this;`."""
    pointed = value.child_by_field_name("argument") if value.type == "pointer_expression" else None
    is_reference = bound.type == "reference_declarator" and pointed is not None and pointed.type == "this"
    return value.type == "this" or is_reference


def _qualifier(reader: ExprReader, declaration: Node) -> str:
    """`const` where a declaration has it."""
    words = [reader.text(child) for child in declaration.children if child.type == "type_qualifier"]
    return "const " if {"const", "constexpr"} & set(words) else ""


def _is_static(reader: ExprReader, declaration: Node) -> bool:
    """Whether a variable of a function keeps what it holds until the next call."""
    specifiers = (child for child in declaration.children if child.type == "storage_class_specifier")
    return any(reader.text(child) == "static" for child in specifiers)
