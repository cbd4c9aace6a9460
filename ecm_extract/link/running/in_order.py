"""Statements of Python in which one call changes what another part reads: in the order in which Python takes them.

Source: docs.python.org, "Expressions", "Evaluation order": from left to right. `a.next() + a.name` is read as
`#next = a.next()`, then `#next + a.name`; what is taken on one side of a choice only is a branch.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from itertools import pairwise
from typing import Final, NamedTuple

from ecm_parsers.source.expr import (
    Call,
    Comprehension,
    Expr,
    Member,
    Name,
    Op,
)
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Block, Branch, Loop, Step, Switch, blocks, rewritten
from msgspec.structs import replace

from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import calls_in, expressions, last_of
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.expression_parts import inner, renumbered, with_inner
from ecm_extract.link.running.names_by_calls import NOTHING, Named, NamesByCalls

_TAKEN: Final = frozenset({"do", "set", "let", "return"})
"""Kinds of statements of which the parts are put in order."""
_CHOICES: Final = frozenset({"&&", "||", "?:"})
TAKEN_FIRST: Final = "#"
"""How the names begin of parts that are taken before their statement, and that no source has."""
MAX_PARTS: Final = 400
"""Parts of a statement that are put in order."""


def settle_order(program: Program) -> Iterator[Place]:
    """Put the parts of statements in order, where that says more than the statement as it stands.

    Yields the places of those that have too many parts, and are left as they stand.
    """
    names = NamesByCalls(program)
    for func in program.every_function():
        if func.file.language == "python":
            ordered = _Ordered(func, names)
            ordered.settle()
            yield from (Place(func.file.path, line) for line in ordered.left)


class Place(NamedTuple):
    """A line of a file."""

    path: str
    line: int


class Part(NamedTuple):
    """A part of a statement that reads or changes something; `first` is the number of the first one within it."""

    named: Named
    first: int


class _Wanted(NamedTuple):
    """Which parts of a statement are taken first, by their numbers, of those that have to do with some names."""

    numbers: Set[int]
    names: Set[str]


class _Asked(NamedTuple):
    """A statement that keeps what a branch or a loop asks."""

    statement: Statement
    wanted: _Wanted


_AS_IT_IS: Final = _Wanted(frozenset(), frozenset())


class _Ordered:
    """The statements of one function; `left` are the lines of those that have too many parts."""

    def __init__(self, func: Func, names: NamesByCalls) -> None:
        self.func = func
        self.names = names
        self.body: list[Statement] = []
        self.left: list[int] = []
        self._steps: list[Block] = []
        self._places: list[int] = []
        self._asked: dict[int, _Asked] = {}
        self._made = 0

    def settle(self) -> None:
        """Have the function read as it runs, where that makes a difference."""
        body, flow = self.func.fact.body, self.func.fact.flow or tuple(range(len(self.func.fact.body)))
        tests = dict(_tested(flow, body))
        wanted = [self._wanted(entry, at) for at, entry in enumerate(body)]
        asked = {at for at, step in tests.items() if self._is_asked_first(step, wanted[at])}
        if not asked and not any(each.numbers for at, each in enumerate(wanted) if at not in tests):
            return
        for at, (statement, each) in enumerate(zip(body, wanted, strict=True)):
            self._write(statement, each if at in asked or at not in tests else _AS_IT_IS, at in asked)
        flow = self._block(flow)
        plain = all(type(step) is int for step in flow)
        self.func.read_as(replace(self.func.fact, body=tuple(self.body), flow=() if plain else flow))

    def _is_asked_first(self, step: Step, wanted: _Wanted) -> bool:
        """Whether what a step asks is asked by a statement before it, which keeps the answer."""
        changes = isinstance(step, Loop) and step.test is not None and any(map(self._is_changing, calls_in(step.test)))
        return changes or (isinstance(step, Branch) and bool(wanted.numbers))

    def _is_changing(self, call: Call) -> bool:
        return bool(self.names.of(call).written)

    def _wanted(self, statement: Statement, at: int) -> _Wanted:
        value = statement.value
        if value is None or statement.kind not in _TAKEN or statement.deferred or statement.type.startswith("yield"):
            return _AS_IT_IS
        calls = [call for call in self.func.calls[at] if self.names.is_run(call)]
        written = frozenset[str]().union(*(self.names.of(call).written for call in calls))
        parts = self.parts(value, written) if written else []
        if len(parts) > MAX_PARTS:
            self.left.append(statement.line)
        return _Wanted(_taken_apart(parts), written) if 1 < len(parts) <= MAX_PARTS else _AS_IT_IS

    def parts(self, expr: Expr, names: Set[str]) -> list[Part]:
        """Return the parts of an expression that read or change some names, in order, inner ones first."""
        found: list[Part] = []
        self._collect(expr, names, found)
        return found

    def _collect(self, expr: Expr, names: Set[str], found: list[Part]) -> None:
        first = len(found)
        for child in inner(expr):
            self._collect(child, names, found)
        named = self.named(expr, names)
        if named != NOTHING:
            found.append(Part(named, first))

    def named(self, expr: Expr, names: Set[str]) -> Named:
        """Return what an expression itself does, beside what stands within it."""
        if isinstance(expr, Name | Member):
            return Named(frozenset(), frozenset({last_of(expr)}) & names)
        if isinstance(expr, Comprehension):
            return self._rounds(expr, names)
        if isinstance(expr, Call) and self.names.is_run(expr):
            found = self.names.of(expr)
            return Named(found.written, found.read & names)
        return NOTHING

    def _rounds(self, expr: Comprehension, names: Set[str]) -> Named:
        """What all rounds of a comprehension do."""
        every = [self.names.of(call) for part in (expr.element, *expr.tests) for call in calls_in(part)]
        read = {last_of(part) for part, _ in expressions(Statement("do", 0, expr.element))}
        written = frozenset[str]().union(*(each.written for each in every))
        return Named(written, frozenset(read).union(*(each.read for each in every)) & names)

    # --- the new body ----------------------------------------------------------------------------------------

    def _write(self, statement: Statement, wanted: _Wanted, is_asked: bool) -> None:
        value = self._moved(statement.value)
        statement = statement if value is statement.value else replace(statement, value=value)
        if is_asked:
            statement = replace(statement, kind="set", target=self.fresh(Name("test")))
            self._asked[len(self._steps)] = _Asked(statement, wanted)
        self._steps.append(self._taken(statement, wanted))
        self._places.append(len(self.body) - 1)

    def _taken(self, statement: Statement, wanted: _Wanted) -> tuple[Step, ...]:
        """The steps that a statement is, itself the last one."""
        before: list[Step] = []
        if wanted.numbers and statement.value is not None:
            statement = replace(statement, value=Taking(self, statement, wanted).value(statement.value, before))
        return (*before, self.add(statement))

    def add(self, statement: Statement) -> int:
        """Add a statement to the body."""
        self.body.append(statement)
        return len(self.body) - 1

    def fresh(self, expr: Expr) -> Name:
        """Return a name that nothing else has, called like what it stands for."""
        self._made += 1
        return Name(f"{TAKEN_FIRST}{last_of(expr.callee if isinstance(expr, Call) else expr)}{self._made}")

    def _moved(self, expr: Expr | None) -> Expr | None:
        """An expression whose loops may stand elsewhere by now."""
        if expr is None or self._places == list(range(len(self._places))):
            return expr
        return renumbered(expr, self._places)

    def _block(self, block: Block) -> Block:
        found: list[Step] = []
        for at, step in enumerate(block):
            before = block[at - 1] if at else -1
            asked = self._asked.get(before) if isinstance(before, int) else None
            found += self._steps[step] if isinstance(step, int) else (self._within(step, asked),)
        return tuple(found)

    def _within(self, step: Step, asked: _Asked | None) -> Step:
        """A step with what it has now within it; `asked` is the statement that asks what it asks."""
        found = rewritten(step, self._block)
        if isinstance(found, Loop) and found.each >= 0:
            return replace(found, each=self._places[found.each])
        if asked is None or not isinstance(found, Loop | Branch) or asked.statement.target is None:
            return found
        if isinstance(found, Branch):
            return replace(found, test=asked.statement.target)
        again = self._taken(asked.statement, asked.wanted)  # before each round
        return replace(found, test=asked.statement.target, step=(*found.step, *again))


class Taking:
    """Takes the parts of one statement in order.

    Args:
        ordered: the statements of its function. statement: the statement. wanted: which parts are taken first.
    """

    def __init__(self, ordered: _Ordered, statement: Statement, wanted: _Wanted) -> None:
        self.ordered = ordered
        self.statement = statement
        self.wanted = wanted
        self._count = 0

    def value(self, expr: Expr, steps: list[Step]) -> Expr:
        """Return what is left of an expression behind steps, which are added."""
        if isinstance(expr, Op) and expr.op in _CHOICES and self._is_wanted(expr):
            return self._chosen(expr, steps)
        left = with_inner(expr, lambda each: self.value(each, steps))
        if self.ordered.named(expr, self.wanted.names) == NOTHING:
            return left
        self._count += 1
        return self._given(self.ordered.fresh(expr), left, steps) if self._count - 1 in self.wanted.numbers else left

    def _is_wanted(self, choice: Op) -> bool:
        """Whether a part is taken first that is taken on one side of a choice only."""
        first, *rest = (len(self.ordered.parts(each, self.wanted.names)) for each in choice.operands)
        begin = self._count + first
        return not self.wanted.numbers.isdisjoint(range(begin, begin + sum(rest)))

    def _chosen(self, choice: Op, steps: list[Step]) -> Name:
        """The variable that a choice gives its value, by branches."""
        name = self.ordered.fresh(Name("chosen"))
        first, *rest = choice.operands
        test = self.value(first, steps)
        if choice.op == "?:":
            asked = self._given(self.ordered.fresh(Name("test")), test, steps) if calls_in(test) else test
            then, other = (self._side(name, each) for each in rest)
            steps.append(Branch(asked, then, other))
            return name
        self._given(name, test, steps)
        asked = name if choice.op == "&&" else Op("!", (name,))
        steps.extend([Branch(asked, self._side(name, each)) for each in rest])
        return name

    def _side(self, name: Name, expr: Expr) -> Block:
        steps: list[Step] = []
        self._given(name, self.value(expr, steps), steps)
        return tuple(steps)

    def _given(self, name: Name, value: Expr, steps: list[Step]) -> Name:
        steps.append(self.ordered.add(replace(self.statement, kind="set", value=value, target=name, type="")))
        return name


def _tested(block: Block, body: Sequence[Statement]) -> Iterator[tuple[int, Step]]:
    """Yield the statements that only do what the step behind them asks, with that step."""
    for before, step in pairwise(block):
        tests = _tests(step)
        if isinstance(before, int) and body[before].kind == "do" and body[before].value in tests:
            yield before, step
    for step in block:
        for within in blocks(step) if not isinstance(step, int) else ():
            yield from _tested(within, body)


def _tests(step: Step) -> Sequence[Expr | None]:
    if isinstance(step, Switch):
        return [step.subject, *(test for case in step.cases for test in case.tests)]
    return [step.test] if isinstance(step, Branch | Loop) else []


def _taken_apart(parts: Sequence[Part]) -> Set[int]:
    """The parts that are taken first: those that change what a later one has to do with, and who reads that before."""
    changing = [at for at, part in enumerate(parts) if any(_changes(part, later) for later in parts[at + 1 :])]
    before = {
        at
        for change in changing
        for at in range(parts[change].first)  # what stands within it is taken with it
        if _changes(parts[change], parts[at])
    }
    return frozenset({*changing, *before})


def _changes(part: Part, other: Part) -> bool:
    """Whether a part may change what another one reads, or changes as well."""
    return not part.named.written.isdisjoint(other.named.read | other.named.written)
