"""What statements of C++ change that they do not name alone: `(test ? a : b).name = text`, `(object.*method)(text)`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.infer.effect import Effect
from ecm_extract.infer.places import chosen

if TYPE_CHECKING:
    from ecm_extract.infer.effects import Effects

CHOOSING: Final = Call(Name("?:"), ())
"""Stands for what gives something to one of several variables, which no call does."""


def given_to_chosen(target: Expr | None, effects: Effects) -> Iterator[Effect]:
    """Yield what an assignment may change: a variable of each side of a choice, or one that a function gets."""
    return _of_sides(target, CHOOSING, effects)


def on_chosen(call: Call, callee: Member, effects: Effects) -> Iterator[Effect]:
    """Yield what a method may change that is called on what a choice, or a function, gives."""
    return _of_sides(callee.base, call, effects)


def by_method_pointer(call: Call, effects: Effects) -> Iterator[Effect]:
    """Yield the object that a method changes which a pointer chooses."""
    root = effects.root(call.callee) if isinstance(call.callee, Op) and not effects.python else ""
    if root:
        yield Effect("lost", root, call)


def _of_sides(expr: Expr | None, call: Call, effects: Effects) -> Iterator[Effect]:
    sides = () if effects.python else chosen(expr)
    return (Effect("lost", root, call) for side in sides if (root := effects.root(side)))
