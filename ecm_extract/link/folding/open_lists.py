"""What an element of a list that is not known depends on: what callers or makers pass for the list, or a parameter."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Number, Op

from ecm_extract.link.code.walk import children
from ecm_extract.link.folding.list_columns import indexed, place_of
from ecm_extract.link.running.env import MAX_DEPTH, Env
from ecm_extract.link.running.values import Hole, Value, given_holes, lowered, parameter, set_by, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_OF_TABLES: Final = frozenset({"items", "keys", "values"})


class OpenLists:
    """Tells who knows the elements of a list that the function at hand does not show."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def element(self, expr: Expr | None, env: Env, whole: bool = False) -> tuple[Value, ...]:
        """Return what an element of such a list is: as long as nobody shows more, `{item}`.

        `whole`: each element is asked for, and so each that a parameter has as long as nobody sets it.
        """
        redefined = self._redefined(expr, env)
        item = parameter(redefined, made=True) if redefined else unknown("item")
        begun = self.folder.list_defaults.elements(expr, env) if whole else ()
        if begun:
            return begun
        if first := self._first_counted(expr, env) if whole else ():
            return (*first, item)
        values = self.folder.fold(expr, env) if isinstance(expr, Name | Member) else ()
        names = [value.parameter for value in values if value.parameter]
        set_by_launch = tuple([value for name in names for value in set_by(name, (item,))])
        return set_by_launch or (self._left_open(expr, env) or item,)

    def part(self, expr: Expr | None, place: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return what a part of each element of such a list is, `place` as `Held.more` has it."""
        at = place_of(place)
        return (self.folder.list_defaults.part(expr, at, env) if at is not None else ()) or self.element(expr, env)

    def _first_counted(self, expr: Expr | None, env: Env) -> tuple[Value, ...]:
        """The first number of `range(count)` that parameters have by default: others follow as these are set."""
        if not isinstance(expr, Call) or expr.callee != Name("range") or expr.keywords:
            return ()
        bounds = [self.folder.fold(bound, env) for bound in expr.args]
        known = [found[0].data for found in bounds if len(found) == 1]
        numbers = [number for number in known if isinstance(number, int)]
        if not 1 <= len(numbers) <= 3 or len(numbers) != len(bounds) or 0 in numbers[2:]:
            return ()
        counted = range(*numbers)
        return lowered(self.folder.fold(Number(counted[0]), env), "default") if counted else ()

    def taken(self, expr: Expr | None, index: Expr, at: object, env: Env) -> tuple[Value, ...]:
        """Return what the element at an index is: that of a parameter's default, as long as nobody sets it."""
        chosen = self.folder.list_defaults.element(expr, env, at)
        return chosen or self.element(expr, env, whole=self._is_of_each(index, expr, env))

    def _is_of_each(self, index: Expr, listed: Expr | None, env: Env) -> bool:
        """Whether an index is that of each element: `i` of `for i in range(len(names))`."""
        ways = self.folder.flow.ways(index, env) if isinstance(index, Name) else ()
        counted = [indexed(held.expr) if held.how == "each" else None for way in ways for held in way]
        return bool(counted) and listed is not None and all(each == listed for each in counted)

    def _redefined(self, expr: Expr | None, env: Env) -> str:
        """The method that gives the list, or the table of `table.items()`, where derived classes may have their own."""
        of_table = isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.name in _OF_TABLES
        listed = expr.callee.base if of_table and isinstance(expr, Call) and isinstance(expr.callee, Member) else expr
        return self.folder.redefined.open_call(listed, env)

    def _left_open(self, expr: Expr | None, env: Env) -> Value | None:
        """An element of what is passed for the list, or for the first that it is made of: who passes one passes all."""
        hole = next(self._holes(expr, env), None) if expr is not None else None
        return Value((hole,), "pattern") if hole is not None else None

    def _holes(self, expr: Expr, env: Env) -> Iterator[Hole]:
        if env.depth > MAX_DEPTH:
            return
        for variable in _variables(expr):
            given = self.folder.names.argument(variable.id, env) if isinstance(variable, Name) else None
            if given is not None:
                yield from self._holes(given.expr, given.env.deeper(env.depth + 1))
                continue
            for value in self.folder.fold(variable, env):
                yield from (hole.of("item") for hole in given_holes(value))


def _variables(expr: Expr) -> Iterator[Name | Member]:
    """What a list is made of: `zip(names, ids)`, `table.items()`, `rows[0]`."""
    if isinstance(expr, Name | Member):
        yield expr
    elif isinstance(expr, Call):
        receiver = (expr.callee.base,) if isinstance(expr.callee, Member) else ()
        for part in (*receiver, *expr.args):
            yield from _variables(part)
    elif isinstance(expr, Op | Items):
        for part in children(expr):
            yield from _variables(part)
