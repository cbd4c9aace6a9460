"""What contexts of Python do with exceptions: `with Quiet():` handles them where a class of the tree says so.

A file does not tell, since the class can stand in another one: each `with` is read as an attempt. One of which nothing
of the tree handles anything is its block, as it stands.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Constant, Expr, Member
from ecm_parsers.source.flow import Attempt, Block, Handler, Later, Leave, Step, blocks, rewritten, steps
from msgspec.structs import replace

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import dotted
from ecm_extract.link.index.bases_outside import bases_outside

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program

_LEAVING: Final = ("__exit__", "__aexit__")
_SOME: Final = ("?",)
"""Types of which nobody knows which they are."""
_FALSE: Final = (Constant("false"), Constant("null"))


def settle_contexts(program: Program) -> None:
    """Read each `with` of a tree as its contexts say."""
    for func in program.every_function():
        if any(isinstance(step, Attempt) and any(map(_is_context, step.handlers)) for step in steps(func.fact.flow)):
            flow = _Contexts(program, func).settled(func.fact.flow)
            plain = all(type(step) is int for step in flow)
            func.fact = replace(func.fact, flow=() if plain else flow)


def _is_context(handler: Handler) -> bool:
    return handler.context is not None


class _Contexts:
    """The contexts of one function."""

    def __init__(self, program: Program, func: Func) -> None:
        self.program = program
        self.func = func

    def settled(self, block: Block) -> Block:
        """Return steps in which only what handles something is an attempt."""
        return tuple([each for step in block for each in self._settled(step)])

    def _settled(self, step: Step) -> Iterator[Step]:
        if isinstance(step, int | Leave):
            yield step
        elif isinstance(step, Attempt) and any(map(_is_context, step.handlers)):
            handlers = tuple([found for each in step.handlers for found in self._handlers(each)])
            body = self.settled(step.body)
            yield from (Attempt(body, handlers),) if handlers else body
        else:
            yield rewritten(step, self.settled)

    def _handlers(self, handler: Handler) -> Iterator[Handler]:
        """The handler that a context is, by the types that it is for; none of what handles nothing."""
        if handler.context is None:
            yield handler
            return
        found = {types for value in self._values(handler.context) if (types := self._handled(value)) is not None}
        if found:
            yield Handler(found.pop() if len(found) == 1 else _SOME, ())

    def _values(self, context: Expr) -> Iterator[Call]:
        """The calls that make what is entered: itself, or those that give a variable something."""
        if isinstance(context, Call):
            yield context
            return
        own = isinstance(context, Member) and context.base == THIS and self.func.cls is not None
        for func in self.func.cls.methods if own and self.func.cls is not None else (self.func,):
            yield from (
                each.value for each in func.fact.body if each.target == context and isinstance(each.value, Call)
            )

    def _by_class(self, cls: Cls) -> tuple[str, ...] | None:
        """What objects of a class handle: nobody knows where a base outside does what is done when a block is left."""
        methods = (each for entry in self.program.ancestry(cls) for each in entry.methods)
        leaving = next((each for each in methods if each.fact.name in _LEAVING), None)
        if leaving is not None:
            return _by_method(leaving)
        return _SOME if any(bases_outside(cls, self.program)) else None

    def _handled(self, call: Call) -> tuple[str, ...] | None:
        """The types of exceptions that a context handles, none for all; None where it lets all pass by."""
        name, file, scope = (dotted(call.callee) or "").replace(".", "::"), self.func.file, self.func.scope
        cls = self.program.class_named(name, file, scope)
        if cls is not None:
            return self._by_class(cls)
        methods = self.func.cls.methods if self.func.cls is not None else ()
        own = [each for each in methods if call.callee == Member(THIS, each.fact.name)]
        return _SOME if any(map(_handles_around, own or self.program.functions_named(name, file, scope))) else None


def _by_method(leaving: Func) -> tuple[str, ...] | None:
    """What a method does that is called where a block is left by an exception: it handles it where it returns true."""
    values = [each.value for each in leaving.fact.body if each.kind == "return"]
    if all(value in _FALSE for value in values):
        return None
    alone = all(value == Constant("true") for value in values) and not leaving.fact.flow
    return () if alone else _SOME


def _handles_around(func: Func) -> bool:
    """Whether a function that is a context gives its value within a `try` with handlers: `@contextmanager`."""
    attempts = (step for step in steps(func.fact.flow) if isinstance(step, Attempt) and step.handlers)
    return bool(func.fact.decorators) and any(_yields(step.body, func) for step in attempts)


def _yields(block: Block, func: Func) -> bool:
    for step in block:
        if isinstance(step, int):
            if func.fact.body[step].type.startswith("yield"):
                return True
        elif not isinstance(step, Later) and any(_yields(inner, func) for inner in blocks(step)):
            return True
    return False
