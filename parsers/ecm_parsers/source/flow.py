"""How the statements of a body follow each other: branches, loops, exits, and what runs later.

A body is a flat list of statements; its flow says which of them run when, by their index in that list. A body whose
statements simply follow each other has no flow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Literal, TypeAlias

import msgspec
from msgspec.structs import replace

from ecm_parsers.source.expr import Expr


class _Step(msgspec.Struct, frozen=True, array_like=True, tag=True, gc=False):
    """Base of all steps but plain statements; the tag is the class name."""


class Branch(_Step, frozen=True):
    """`if (test) then else other`."""

    test: Expr
    then: Block
    other: Block = ()


class Loop(_Step, frozen=True):
    """A loop; what stands before a `for` is in the block around it.

    Attributes:
        each: index of the `each` statement that binds what the loop is over; -1 for other loops.
        test: condition; None where there is none.
        body: what is repeated. step: what is done after each round. other: Python's `else`.
        first: the body runs before the test is asked (`do`).
    """

    each: int
    test: Expr | None
    body: Block
    step: Block = ()
    other: Block = ()
    first: bool = False


class Case(_Step, frozen=True):
    """One case of a switch; without tests it is the default."""

    tests: tuple[Expr, ...]
    body: Block


class Switch(_Step, frozen=True):
    """A switch of C++ (a case falls into the next one), a match of Python, a chain of `else if`.

    The tests of a chain are conditions of their own; its subject is `true`.
    """

    subject: Expr
    cases: tuple[Case, ...]
    falls: bool


class Handler(_Step, frozen=True):
    """What handles an exception, by the types that it is for as they are written; without types it is for all.

    `name` is the variable of Python that it has the exception in. `context` is what `with` enters, of which its class
    tells whether it handles anything.
    """

    types: tuple[str, ...]
    body: Block
    name: str = ""
    context: Expr | None = None


class Attempt(_Step, frozen=True):
    """`try`: its body, its handlers, what runs where nothing was raised, what runs in the end."""

    body: Block
    handlers: tuple[Handler, ...]
    other: Block = ()
    final: Block = ()


class Leave(_Step, frozen=True):
    """What ends a path: a `return` without a value, `break`, `continue`, `throw` or `raise`, `goto`.

    Attributes:
        raised: what is raised as it is written, without its arguments: a type, or a variable; empty for what is
            raised again.
    """

    how: Literal["return", "break", "continue", "throw", "goto"]
    raised: str = ""


class Later(_Step, frozen=True):
    """The body of an anonymous lambda with its parameters: it runs when somebody calls it."""

    body: Block
    params: tuple[str, ...] = ()


Step: TypeAlias = int | Branch | Loop | Switch | Attempt | Leave | Later
Block: TypeAlias = tuple[Step, ...]


class FlowWriter:
    """Collects the steps of one body while it is read."""

    def __init__(self) -> None:
        self._open: list[list[Step]] = [[]]

    def add(self, step: Step) -> None:
        """Add a step to the block at hand."""
        self._open[-1].append(step)

    def begin(self) -> None:
        """Begin a block within the one at hand."""
        self._open.append([])

    def end(self) -> Block:
        """End the block at hand and return its steps."""
        return tuple(self._open.pop())

    def flow(self) -> Block:
        """Return the steps of the body; nothing where its statements simply follow each other."""
        steps = self._open[0]
        return () if all(type(step) is int for step in steps) else tuple(steps)


def blocks(step: Step) -> Iterator[Block]:
    """Yield the blocks within a step."""
    if isinstance(step, Branch):
        yield from (step.then, step.other)
    elif isinstance(step, Loop):
        yield from (step.body, step.step, step.other)
    elif isinstance(step, Switch):
        yield from (case.body for case in step.cases)
    elif isinstance(step, Attempt):
        yield from (step.body, *[handler.body for handler in step.handlers], step.other, step.final)
    elif isinstance(step, Later):
        yield step.body


def rewritten(step: Step, change: Callable[[Block], Block]) -> Step:
    """Return a step with other blocks in it."""
    if isinstance(step, Branch):
        return replace(step, then=change(step.then), other=change(step.other))
    if isinstance(step, Loop):
        return replace(step, body=change(step.body), step=change(step.step), other=change(step.other))
    if isinstance(step, Switch):
        return replace(step, cases=tuple([replace(case, body=change(case.body)) for case in step.cases]))
    if isinstance(step, Attempt):
        handlers = tuple([replace(handler, body=change(handler.body)) for handler in step.handlers])
        return Attempt(change(step.body), handlers, change(step.other), change(step.final))
    return replace(step, body=change(step.body)) if isinstance(step, Later) else step


def steps(block: Block) -> Iterator[Step]:
    """Yield the steps of a block that are no statements, at any depth."""
    for step in block:
        if not isinstance(step, int):
            yield step
            for inner in blocks(step):
                yield from steps(inner)


def statements(block: Block) -> Iterator[int]:
    """Yield the statements of steps, at any depth, by their index."""
    for step in block:
        if isinstance(step, int):
            yield step
            continue
        if isinstance(step, Loop) and step.each >= 0:
            yield step.each
        for inner in blocks(step):
            yield from statements(inner)
