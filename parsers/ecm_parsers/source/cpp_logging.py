"""Macros of C++ that print, and what their arguments do beside: `ROS_ERROR_COND(!nh.getParam("x", x), "no x")`."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

import msgspec

from ecm_parsers.source.cpp_effects import shifted
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_statements import StatementWriter
from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Name, Op, Opaque
from ecm_parsers.source.flow import Branch

if TYPE_CHECKING:
    from tree_sitter import Node


class _Table(msgspec.Struct, frozen=True):
    """What is known of such macros; see cpp_logging.toml."""

    printing: tuple[str, ...]
    asserting: tuple[str, ...]
    sometimes: tuple[str, ...]
    condition: Mapping[str, int]
    asking: frozenset[str]


@cache
def _table() -> _Table:
    text = (files("ecm_parsers") / "source" / "cpp_logging.toml").read_text("utf-8")
    return msgspec.convert(tomllib.loads(text), _Table)


def macro_that_prints(node: Node) -> str:
    """Return the name of the macro that a call is of, if that prints or compares what it gets; empty for others."""
    callee = node.child_by_field_name("function") if node.type == "call_expression" else None
    if callee is None or callee.type != "identifier":
        return ""
    name = (callee.text or b"").decode(errors="replace")
    return name if is_printing(name) else ""


def is_printing(name: str) -> bool:
    """Tell whether a macro prints or compares what it gets, unless a tree says what it stands for."""
    return name.isupper() and name.startswith(_table().printing) and not name.startswith(_table().asserting)


class Printing:
    """Writes what the arguments of such macros do.

    Args:
        expr: reads them, and writes what they change on the way.
        writer: takes the statements.
    """

    def __init__(self, expr: ExprReader, writer: StatementWriter) -> None:
        self.expr = expr
        self.writer = writer

    def read(self, macro: str, node: Node) -> None:
        """Read the arguments of a call of a macro, which may not be evaluated where it prints sometimes only.

        What tells whether it prints is evaluated first.
        """
        given = node.child_by_field_name("arguments")
        arguments = list(given.named_children) if given is not None else []
        asked = next((at for word, at in _table().condition.items() if word in macro), None)
        if asked is not None and asked < len(arguments):
            self._argument(arguments.pop(asked))
        self.writer.begin()
        for argument in arguments:
            self._argument(argument)
        steps = self.writer.end()
        if steps and any(word in macro for word in _table().sometimes):
            steps = (Branch(Opaque(macro), steps),)
        for step in steps:
            self.writer.step(step)

    def _argument(self, node: Node) -> None:
        for part in shifted(self.expr.read(node)):  # a stream gets them, whatever the first is
            if _does_something(part):
                self.writer.add("do", node, part)


def _does_something(value: Expr) -> bool:
    """Whether an expression calls anything but what only asks an object."""
    if isinstance(value, Call):
        callee, asking = value.callee, _table().asking
        if isinstance(callee, Member) and callee.name in asking and not value.args:
            return _does_something(callee.base)
        return not (isinstance(callee, Name) and callee.id in asking and not value.args)
    if isinstance(value, Member):
        return _does_something(value.base)
    if isinstance(value, Op):
        return any(map(_does_something, value.operands))
    return isinstance(value, Lambda)
