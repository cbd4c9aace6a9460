"""Containers of C++ that are made by a call of their type: their elements."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.numbers import nothing_of
from ecm_extract.link.folding.python_lists import MAX_ITEMS
from ecm_extract.link.folding.subscripts import copied_range, steps_on
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold_lists import ListFolder


def made_elements(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    """`vector{a, b}`, whose elements are one list, `vector(other)`, `vector<T>(count)`, `vector(count, value)`."""
    args = call.args
    if len(args) == 1:
        listed = lists.items(args[0], env)
        return listed if listed is not None else _counted(lists, args[0], None, call, env)
    copied = copied_range(args)
    if copied is not None:
        return lists.items(copied, env)
    if len(args) == 2 and not any(map(steps_on, args)):
        return _counted(lists, args[0], args[1], call, env)
    return None if args else []


def _counted(lists: ListFolder, count: Expr, each: Expr | None, call: Invocation, env: Env) -> list[Bound] | None:
    """So many of one value, without one of what an element is that is given nothing."""
    known = lists.folder.fold(count, env)
    number = known[0].data if len(known) == 1 and is_proved(known[0]) else None
    if not isinstance(number, int) or isinstance(number, bool) or not 0 <= number <= MAX_ITEMS:
        return None
    each = each if each is not None else nothing_of(call.types[0] if call.types else "")
    return [Bound(each, env)] * number if each is not None else None
