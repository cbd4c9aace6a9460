"""Folding: the text an expression has, as far as the tree shows it.

Follows DESIGN §4: constants, concatenation, formats, members set in constructors, parameters with their
defaults, functions that return a value. Every result has a confidence; unknown parts stay as holes.
"""

from __future__ import annotations

from collections.abc import Callable

from ecm_parsers.source.expr import (
    Call,
    Constant,
    Expr,
    Member,
    Name,
    Number,
    Op,
    Opaque,
    Template,
    Text,
)

from ecm_extract.link import formats
from ecm_extract.link.env import MAX_DEPTH, Env
from ecm_extract.link.fold_calls import CallFolder
from ecm_extract.link.fold_fields import FieldFolder
from ecm_extract.link.fold_lists import ListFolder
from ecm_extract.link.fold_members import MemberFolder
from ecm_extract.link.fold_names import NameFolder
from ecm_extract.link.objects import Objects
from ecm_extract.link.parameter_reads import ParameterReads
from ecm_extract.link.program import Program
from ecm_extract.link.scope import Scope
from ecm_extract.link.steps import Steps
from ecm_extract.link.values import (
    Value,
    demoted,
    joined,
    literal,
    unique,
    unknown,
)

_Asked = tuple[int, str, int, int, int, int, int]
"""A name with everything that its value depends on."""


class Folder:
    """Evaluates expressions of a program."""

    def __init__(self, program: Program, scope: Scope, reads: ParameterReads) -> None:
        self.program = program
        self.scope = scope
        self.objects = Objects(program, scope)
        self.reads = reads
        self.names = NameFolder(self)
        self.members = MemberFolder(self)
        self.fields = FieldFolder(self)
        self.calls = CallFolder(self)
        self.lists = ListFolder(self)
        self.cuts = 0
        self._cycles = 0
        self.steps = Steps(sum(len(func.fact.body) for group in program.functions.values() for func in group))
        self._active: set[tuple[int, str, int]] = set()
        self._answers: dict[_Asked, tuple[Env, tuple[Value, ...]]] = {}

    def fold(self, expr: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the possible values of an expression, at least one."""
        if not self.steps.depth:
            self._answers.clear()  # more may be known of parameters by now
        if expr is None or env.depth > MAX_DEPTH or not self.steps.take(env):
            self.cuts += 1
            return (unknown("value"),)
        with self.steps:
            return self._by_kind(expr, env)

    def _by_kind(self, expr: Expr, env: Env) -> tuple[Value, ...]:
        match expr:
            case Name():
                return self.names.name(expr, env)
            case Member():
                return self.members.member(expr, env)
            case Call():
                return self.calls.call(expr, env)
            case Op():
                return self.op(expr, env)
            case Template():
                return joined(self.fold(part, env.before(env.at)) for part in expr.parts)
            case Text() | Number():
                return (literal(str(expr.value)),)
            case Constant():
                return (literal("" if expr.name == "null" else expr.name),)
            case Opaque() if expr.text.isidentifier():
                return (unknown(expr.text),)
        return (unknown("value"),)

    def guarded(self, label: str, env: Env, work: Callable[[], tuple[Value, ...]]) -> tuple[Value, ...]:
        """Break cycles such as `x = f(x)` in a loop or members that are set from each other."""
        key = (id(env.func), label, env.at)
        if key in self._active or len(self._active) > 60:
            self.cuts += 1
            self._cycles += 1
            return (unknown(label),)
        self._active.add(key)
        try:
            return work()
        finally:
            self._active.discard(key)

    def once(self, label: str, env: Env, work: Callable[[], tuple[Value, ...]]) -> tuple[Value, ...]:
        """Answer a question that several branches ask once, as long as no cycle had a part in the answer."""
        key = (id(env.func), label, env.at, env.depth, id(env.args), id(env.this), id(env.made))
        known = self._answers.get(key)
        if known is not None:
            return known[1]
        cycles = self._cycles
        values = self.guarded(label, env, work)
        if self.steps.depth and cycles == self._cycles:
            self._answers[key] = (env, values)  # with the environment, so that no other one gets its identity
        return values

    def forget(self) -> None:
        """Drop remembered members, since more of the parameters is known now."""
        self.members.forget()
        self.reads.forget()

    def op(self, expr: Op, env: Env) -> tuple[Value, ...]:
        """Concatenation, conditionals, `%` formats, subscripts."""
        inner = env.before(env.at)
        if expr.op == "+" and len(expr.operands) >= 2:
            return joined(self.fold(operand, inner) for operand in expr.operands)
        if expr.op == "?:":
            values = [value for operand in expr.operands[1:] for value in self.fold(operand, inner)]
            empty = [value for value in values if value.parts == ("",)]  # a prefix that may be missing
            return tuple(dict.fromkeys((*unique(demoted(values)), *demoted(empty))))
        if expr.op == "%" and isinstance(expr.operands[0], Text):
            return joined(self.calls.folded_parts(formats.percent(expr.operands[0].value, expr.operands[1]), env))
        if expr.op == "||":
            return unique(value for operand in expr.operands for value in self.fold(operand, inner))
        if expr.op == "[]":
            return self.lists.elements(expr.operands[0], inner, expr.operands[1])
        if expr.op == "&":
            return self.fold(expr.operands[0], inner)
        return (unknown("value"),)
