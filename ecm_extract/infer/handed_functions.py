"""What functions of Python do that calls get: `map(box.put, names)`, `map(lambda x: x.go(), rows)`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Lambda, Member, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effect import Effect
from ecm_extract.infer.reading_calls import leaves_arguments
from ecm_extract.link.code.walk import calls_in, given_to, names_in

if TYPE_CHECKING:
    from ecm_extract.infer.effects import Effects


class HandedFunctions:
    """Tells it of the calls of one function."""

    def __init__(self, effects: Effects) -> None:
        self.effects = effects

    def given(self, call: Call, last: str, at: int) -> Iterator[Effect]:
        """Yield what functions do that a call gets: lambdas to objects, others where `map` and the like call them.

        They change what these give them, and what they are methods of.
        """
        func, parameters = self.effects.func, self.effects.targets.parameters
        given = given_to(call) if self.effects.python else ()
        called = [each.callee for made in given if isinstance(made, Lambda) for each in calls_in(made.body)]
        if last in self.effects.calls.calling:
            for each in _called_with_parts(call, lambda made: self._may_change_it(made, at), func.fact.body):
                if key := self.effects.key(each):
                    yield Effect("reached" if each in given else "lost", key, call)
            called += given
        methods = (each for each in called if isinstance(each, Member) and each.base != THIS)
        bases = (each.base for each in methods if parameters.changes_object(each, func, at))
        yield from (Effect("lost", root, call) for base in bases if (root := self.effects.root(base)))

    def _may_change_it(self, call: Call, at: int) -> bool:
        """Whether a call of a function of Python that is handed on may change the first thing that it gets."""
        callee, parameters = call.callee, self.effects.targets.parameters
        if isinstance(callee, Lambda):
            return callee.body is None or any(self._changes_any(made, callee, at) for made in calls_in(callee.body))
        if isinstance(callee, Member) and self.effects.is_of_class(callee):
            return parameters.changes_object(callee, self.effects.func, at)
        return parameters.may_by(call, self.effects.func, at)

    def _changes_any(self, call: Call, of: Lambda, at: int) -> bool:
        """Whether a call in a lambda may change what that gets, or a part of it."""
        func, targets, callee = self.effects.func, self.effects.targets, call.callee
        if isinstance(callee, Member) and not set(of.params).isdisjoint(names_in(callee.base)):
            return targets.parameters.changes_object(callee, func, at)
        if all(set(of.params).isdisjoint(names_in(arg)) for arg in given_to(call)):
            return False
        target = targets.target(call, func, at)
        if target is None:
            return not leaves_arguments(callee, func)
        return any(targets.parameters.may(target, entry.name) for entry in target.fact.params)


def _called_with_parts(call: Call, changes: Callable[[Call], bool], body: Sequence[Statement]) -> Iterator[Expr]:
    """Yield the variables whose elements a call like `map` gives to a function that may change them.

    Args:
        call: the call.
        changes: tells whether a call may change its argument.
        body: the statements of its function.
    """
    given = given_to(call)
    parts = (*given, call.callee.base) if isinstance(call.callee, Member) else given
    functions = [arg for arg in given if isinstance(arg, Name | Member | Lambda)]
    for arg in parts:
        if any(changes(Call(_as_callee(each), (arg,))) for each in functions if each is not arg):
            yield from shared_names(arg, body)


def _as_callee(function: Expr) -> Expr:
    return Name(function.name) if isinstance(function, Lambda) and function.name else function
