"""How many values Python functions return and members of classes hold, where the sources leave no doubt."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final, Literal, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Number, Op, Table, Template, Text
from ecm_parsers.source.facts import Function, Statement

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import calls_in

_EMPTY: Final = frozenset({"dict", "list", "OrderedDict", "collections.OrderedDict", "deque", "collections.deque"})
_READERS: Final = frozenset({"len", "sorted", "enumerate", "list", "tuple", "zip", "print", "str", "any", "all"})
_CHANGES: Final = frozenset({"insert", "extend", "update", "setdefault", "appendleft"})


class Count(NamedTuple):
    """A number of values, with the place that shows it: path in the tree, 1-based line."""

    values: int
    path: str
    line: int


class Taken(NamedTuple):
    """An element of a member of `self`: by a key, or by a loop over the member itself, its values or its items."""

    member: str
    how: Literal["key", "each", "values", "items"]


def returned(func: Func) -> Count | None:
    """Return how many values every `return` of a function displays; None where they differ or one is no display."""
    values = returned_values(func.fact)
    values = values if values != 1 else None
    lines = [entry.line for entry in func.fact.body if entry.kind == "return"]
    return Count(values, func.file.path, lines[0]) if values is not None else None


def returned_values(function: Function) -> int | None:
    """Return the number alone, 1 for an object; decorators may make something else of what is returned."""
    counts = {_values_of(entry.value, function) for entry in function.body if entry.kind == "return"}
    return counts.pop() if len(counts) == 1 and not function.decorators else None


def _values_of(value: Expr | None, function: Function) -> int | None:
    if isinstance(value, Name):
        kinds = {_is_object(entry.value) for entry in function.body if entry.target == value}
        return 1 if kinds == {True} else None
    return 1 if _is_object(value) else count_of(value)


def _is_object(value: Expr | None) -> bool:
    """Whether an expression is surely one thing: a literal, or an object of a class."""
    made = last_name(dotted_name(value.callee)) if isinstance(value, Call) else ""
    return isinstance(value, Text | Number | Template) or (made[:1].isupper() and not made.isupper())


def held(taken: Taken, classes: Iterable[Cls]) -> Count | None:
    """Return how many values each element of a member has.

    None where elements differ or one is not a display, and where the member may be filled in another way.
    """
    member = Member(THIS, taken.member)
    methods = [method for cls in classes for method in cls.methods]
    steps = [(statement, method) for method in methods for statement in method.fact.body]
    if any(_is_filled_otherwise(statement, member) for statement, _ in steps):
        return None
    given = [(step, method) for step, method in steps if _at(step.target) == member and step.type != "del"]
    by_key = [(step.value, method, step.line) for step, method in given]
    appended = [(arg, method, step.line) for step, method in steps for arg in _appended(step, member)]
    if (by_key and taken.how == "each") or (appended and taken.how in {"values", "items"}):
        return None  # a loop over a dictionary gives its keys
    return _agreed([*by_key, *appended])


def taken_by(value: Expr | None) -> Taken | None:
    """Return which element of a member of `self` an expression or a loop over it gives."""
    match value:
        case Op("[]", (Member(Name("this"), name), _)):
            return Taken(name, "key")
        case Call(Member(Member(Name("this"), name), "values" | "itervalues"), ()):
            return Taken(name, "values")
        case Call(Member(Member(Name("this"), name), "items" | "iteritems"), ()):
            return Taken(name, "items")
        case Member(Name("this"), name):
            return Taken(name, "each")
    return None


def count_of(value: Expr | None) -> int | None:
    """Return how many values a display of at least two has; None where a star puts in any number."""
    if not isinstance(value, Items) or len(value.items) < 2:
        return None
    return None if any(map(_is_spread, value.items)) else len(value.items)


def _is_spread(item: Expr) -> bool:
    return isinstance(item, Op) and item.op == "*" and len(item.operands) == 1


def _agreed(entries: Iterable[tuple[Expr | None, Func, int]]) -> Count | None:
    """The count that all have in common, shown by the first."""
    found = [(count_of(value), func.file.path, line) for value, func, line in entries]
    values, path, line = found[0] if found else (None, "", 0)
    if values is None or any(count != values for count, _, _ in found):
        return None
    return Count(values, path, line)


def _at(target: Expr | None) -> Expr | None:
    """What a subscript is taken of."""
    return target.operands[0] if isinstance(target, Op) and target.op == "[]" else None


def _appended(statement: Statement, member: Member) -> Iterator[Expr]:
    for call in calls_in(statement.value):
        if call.callee == Member(member, "append"):
            yield from call.args


def _is_filled_otherwise(statement: Statement, member: Member) -> bool:
    """Whether a statement binds the member to something that is not empty, or lets somebody else change it."""
    if statement.target == member and statement.type != "del" and not _is_empty(statement.value):
        return True
    return any(_changes(call, member) for call in calls_in(statement.value))


def _is_empty(value: Expr | None) -> bool:
    match value:
        case Items(()) | Table(()) | None:
            return True
        case Call(callee, ()):
            return dotted_name(callee) in _EMPTY
    return False


def _changes(call: Call, member: Member) -> bool:
    callee = call.callee
    if isinstance(callee, Member) and callee.base == member:
        return callee.name in _CHANGES
    return member in call.args and dotted_name(callee) not in _READERS
