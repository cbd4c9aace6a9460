"""Objects that have nothing to do with each other in a function: what one of them is given the other is not."""

from __future__ import annotations

from collections.abc import Sequence, Set

from ecm_parsers.source.expr import Expr, Number, Text

from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import names_in
from ecm_extract.link.folding.subscripts import taken


class OtherObjects:
    """Tells objects apart by the statements that name both of them, or what they were made with."""

    def __init__(self) -> None:
        self._groups: dict[Func, Sequence[Set[str]]] = {}

    def are_apart(self, one: Expr, other: Expr, func: Func) -> bool:
        """Tell whether no statement of a function can have made two objects the same, or one a copy of the other."""
        first, second = set(names_in(one)), set(names_in(other))
        if not first or not second:
            return False
        if not first.isdisjoint(second):
            return _are_two_elements(one, other)
        return all(group.isdisjoint(first) or group.isdisjoint(second) for group in self._of(func))

    def _of(self, func: Func) -> Sequence[Set[str]]:
        """The variables that statements join, in groups."""
        if func not in self._groups:
            groups: list[Set[str]] = []
            for statement in func.fact.body:
                named = {*names_in(statement.target), *names_in(statement.value)}
                touched = [group for group in groups if not group.isdisjoint(named)]
                apart = [group for group in groups if group.isdisjoint(named)]
                groups = [*apart, named.union(*touched)] if named else groups
            self._groups[func] = groups
        return self._groups[func]


def is_one_of_several(expr: Expr) -> bool:
    """Tell whether an object is an element: `rows[0]`, `rows.at(0)`."""
    return taken(expr) is not None


def _are_two_elements(one: Expr, other: Expr) -> bool:
    """Whether two objects are elements of one container by keys that differ."""
    first, second = taken(one), taken(other)
    if first is None or second is None or first[0] != second[0]:
        return False
    stated = all(isinstance(key, Number | Text) for key in (first[1], second[1]))
    return stated and first[1] != second[1]
