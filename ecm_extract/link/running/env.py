"""Where an expression is evaluated: the function, what its parameters are bound to, how `this` was made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import State
from ecm_extract.link.code.calls import Invocation, Step, invocation
from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.running.run_keys import RunKey

MAX_DEPTH = 32
"""Nesting of evaluations beyond which a value counts as unknown."""


@dataclass(slots=True, eq=False, repr=False)
class Bound:
    """An argument: its expression and where that is evaluated."""

    expr: Expr
    env: Env


@dataclass(slots=True, eq=False, repr=False)
class Instance:
    """One way an object of a class is made.

    Attributes:
        cls: the class.
        args: constructor parameter -> argument.
        types: template parameter of the class -> argument as written.
        maker: the constructor that is called, when known.
        exact: whether the object is known to be of no derived class, whatever else is known of it.
    """

    cls: Cls
    args: Mapping[str, Bound]
    types: Mapping[str, str]
    maker: Func | None = None
    exact: bool = False

    @property
    def is_one(self) -> bool:
        """Whether it is one way, and not any in which an object of the class, or of a derived one, may be made."""
        return bool(self.exact or self.args or self.types or self.maker)


@dataclass(slots=True, eq=False, repr=False)
class Env:
    """A place of evaluation.

    Attributes:
        func: the function at hand.
        at: index of the statement at hand; only earlier ones have happened.
        args: parameter of `func` -> argument; parameters missing here are unknown.
        types: template parameter -> argument, resolved where possible.
        this: concrete class of `this`.
        made: how `this` was made, when one way is looked at.
        depth: nesting of evaluations so far.
        state: what the variables hold there; None for every state in which the statement is reached.
        outer: the place that calls a function which is declared there, and so sees its variables.
        caller: the object that a method is called on, as who calls it writes it; None where that is not known.
        call: the call that led here, with its place, where what the function does depends on when it is called.
        asked: what tells runs apart, once that was asked (see `flow`).
    """

    func: Func
    at: int = 1_000_000
    args: Mapping[str, Bound] = field(default_factory=dict)
    types: Mapping[str, str] = field(default_factory=dict)
    this: Cls | None = None
    made: Instance | None = None
    depth: int = 0
    state: State | None = None
    outer: Env | None = None
    caller: Bound | None = None
    call: Bound | None = None
    asked: RunKey | None = None

    def before(self, at: int) -> Env:
        """The same place, at another statement."""
        state = self.state if at == self.at else None
        return self._at(at, self.depth + 1, state)

    def within(self, state: State | None, at: int) -> Env:
        """The same function, at a statement and in one state of it."""
        return self._at(at, self.depth, state)

    def deeper(self, depth: int) -> Env:
        """The same place, as a part of an evaluation that is so deep."""
        return self._at(self.at, depth, self.state)

    def entry(self, state: State | None = None) -> Env:
        """The beginning of the function, as a part of an evaluation at this place."""
        return self._at(0, self.depth + 1, state)

    def _at(self, at: int, depth: int, state: State | None) -> Env:
        around = (self.outer, self.caller, self.call)
        return Env(self.func, at, self.args, self.types, self.this, self.made, depth, state, *around)

    @property
    def scope(self) -> str:
        """Qualified scope of the function, the function itself included."""
        fact = self.func.fact
        return f"{fact.scope}::{fact.name}" if fact.scope else fact.name


def invocation_of(expr: Call, env: Env) -> Invocation:
    """Return a call expression at a place as the forms see it."""
    body = env.func.fact.body
    at = min(env.at, max(len(body) - 1, 0))
    statement = body[at] if body else Statement("do", env.func.fact.line, expr)
    return invocation(Step(env.func, at, statement), expr)
