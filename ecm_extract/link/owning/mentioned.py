"""The names that the body of a function mentions: what it can call, make or hand over."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Name, Text
from ecm_parsers.source.facts import Class, Statement

from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children

_PIECE: Final = re.compile(r"\w+|::|[<>]")
_BY_NAME: Final = frozenset({"getattr", "methodcaller"})
_BY_ANY_NAME: Final = frozenset({"globals", "import_module", "__import__"})


class Within(NamedTuple):
    """A name that a type asks of another: `Tools::SharedPtr`.

    `placed`: the other one has a namespace or arguments, `rclcpp::Node::SharedPtr`: no parameter of a template has.
    """

    name: str
    around: str
    placed: bool


class OfName(NamedTuple):
    """A name that is asked of another name, which may be a class: `Robot.main`."""

    name: str
    owner: str


@dataclass(slots=True)
class Mentions:
    """Last names that are called, made or handed over: `plain` ones stand alone, `used` ones are asked of something.

    `of_names`: used ones that are asked of a name. `held`: something is asked of it. `within`: names that types ask of
    others.
    `any`: it calls what nobody knows before it runs; `any_method`: of some object.
    """

    plain: set[str] = field(default_factory=set)
    used: set[str] = field(default_factory=set)
    of_names: set[OfName] = field(default_factory=set)
    held: set[str] = field(default_factory=set)
    within: set[Within] = field(default_factory=set)
    any: bool = False
    any_method: bool = False

    def add(self, expr: Expr) -> None:
        """Take in an expression with all its parts."""
        pending: list[Expr] = [expr]
        while pending:
            pending += self._parts(pending.pop())

    def add_type(self, written: str) -> None:
        """Take in a type: whoever declares an object of it can make one."""
        for name in _names(written):
            if name.around:
                self.within.add(name)
            else:
                self.used.add(name.name)

    def _parts(self, expr: Expr) -> Iterator[Expr]:
        if isinstance(expr, Name):
            (self.used if "::" in expr.id else self.plain).add(last_name(expr.id))
        elif isinstance(expr, Member):
            yield from self._member(expr)
            return
        elif isinstance(expr, Call):
            self._call(expr)
        elif isinstance(expr, Lambda) and expr.name:
            self.plain.add(expr.name)
        yield from children(expr)

    def _member(self, expr: Member) -> Iterator[Expr]:
        """`a.b.c()`: `c` is asked of `b`, which is asked of `a`; of a class it may be asked without an object."""
        base = expr.base
        if isinstance(base, Name):
            self.of_names.add(OfName(expr.name, base.id))
        else:
            self.used.add(expr.name)
        while isinstance(base, Member):
            self.held.add(base.name)
            base = base.base
        if isinstance(base, Name):
            self.held.add(last_name(base.id))
        else:
            yield base

    def _call(self, call: Call) -> None:
        for written in call.types:
            self.add_type(written)
        name = last_name(call.callee.id) if isinstance(call.callee, Name) else ""
        if name in _BY_NAME:
            named = [arg for arg in call.args[-2:] if isinstance(arg, Text)]
            self.used.update(text.value for text in named)
            self.any_method = self.any_method or not named
        self.any = self.any or name in _BY_ANY_NAME


def _names(written: str) -> Iterator[Within]:
    """Yield the names in a type, each with the one that it is asked of; empty for none."""
    last, asked, placed = "", "", False
    opened: list[str] = []
    for piece in _PIECE.findall(written):
        if piece == "<":
            opened.append(last)
        elif piece == ">":
            last, placed = opened.pop() if opened else "", True
        elif piece == "::":
            asked = last
        else:
            yield Within(piece, asked, placed)
            last, asked, placed = piece, "", bool(asked)


def mentions_of(func: Func) -> Mentions:
    """Return the names in the body of a function, in the defaults of its parameters and in its decorators."""
    found = Mentions()
    for statement in func.fact.body:
        _add_statement(found, statement)
    for parameter in func.fact.params:
        if parameter.default is not None:
            found.add(parameter.default)
        found.add_type(parameter.type)
    for decorator in func.fact.decorators:
        found.add_type(decorator)
    return _without_variables(found, func)


def _without_variables(found: Mentions, func: Func) -> Mentions:
    """A variable of a function hides a class of its name: what is asked of it may be of any object."""
    targets = {statement.target.id for statement in func.fact.body if isinstance(statement.target, Name)}
    hidden = targets.union(parameter.name for parameter in func.fact.params)
    for each in [each for each in found.of_names if each.owner in hidden]:
        found.of_names.remove(each)
        found.used.add(each.name)
    return found


def _add_statement(found: Mentions, statement: Statement) -> None:
    for expr in (statement.target, statement.value):
        if expr is not None:
            found.add(expr)
    if statement.type:
        found.add_type(statement.type)


def mentions_of_class(fact: Class) -> Mentions:
    """Return the names in the members of a class."""
    found = Mentions()
    for entry in fact.fields:
        found.add_type(entry.type)
        if entry.default is not None:
            found.add(entry.default)
    return found
