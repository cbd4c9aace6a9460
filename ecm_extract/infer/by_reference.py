"""What functions of C++ do to variables that they get by reference, by address, or by a pointer that is handed on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Op

from ecm_extract.infer.effect import Effect
from ecm_extract.link.code.spelling import may_be_written

if TYPE_CHECKING:
    from ecm_extract.infer.effects import Effects
    from ecm_extract.link.code.units import Func


def by_reference(call: Call, arg: Expr, target: Func, name: str, effects: Effects) -> Iterator[Effect]:
    """Yield what a call does to the variable that an argument of it is, or leads into.

    Args:
        call: of a function of the tree.
        arg: one of its arguments.
        target: the function.
        name: of the parameter that the argument is there.
        effects: of the function that calls.
    """
    written = next((entry.type for entry in target.fact.params if entry.name == name), "")
    key, root = effects.key(arg), effects.key(arg) or effects.root(arg)
    if effects.iterates(arg):
        yield Effect("lost", root, call)
    elif not may_be_written(written):
        return
    elif written.rstrip().endswith("*") and not (isinstance(arg, Op) and arg.op == "&"):
        yield from _by_pointer(call, key or root, target, name, effects)
    elif key and not written.endswith("&&"):
        yield from _out(key, call, target, name, effects)
    else:
        yield Effect("lost", root, call, name)


def _by_pointer(call: Call, root: str, target: Func, name: str, effects: Effects) -> Iterator[Effect]:
    """What a function does to what a pointer leads to that it gets: to a part of that, or to all of it."""
    parameters = effects.targets.parameters
    array = effects.func.written_types.get(root, "").endswith("[]")
    if array or parameters.may(target, name):
        yield Effect("lost", root, call)
    elif parameters.gives(target, name):
        yield Effect("out", root, call, name)
    elif parameters.hands(target, name):
        yield Effect("handed", root, call)


def _out(key: str, call: Call, target: Func, name: str, effects: Effects) -> Iterator[Effect]:
    """What a function does to a variable that it gets by reference: to some of its fields, or to all of it."""
    fields = effects.targets.parameters.fields(target, name)
    for each in (name,) if fields is None else sorted(fields):
        yield Effect("out", key + each.removeprefix(name), call, each)
