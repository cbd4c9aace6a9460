"""Elements of lists that parameters are, as long as nobody sets these."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.folding.list_columns import column
from ecm_extract.link.folding.subscripts import part_of
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, invocation_of
from ecm_extract.link.running.values import Value, lowered, set_by
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_VALUES = "link/code/library_values.toml"
_UNWRAPPING: Final = shipped_names(_VALUES, "parameter_values") | shipped_names(_VALUES, "parameter_texts")
_COPIES: Final = frozenset({"list", "tuple"})
"""Classes of Python that make a list of the elements of another one, in their order."""
_CHANGED: Final = frozenset({"changed", "stored", "out", "handed", "reached", "after", "lost"})
"""What becomes of a list that is not, or need not be, what it was read as."""


class Read(NamedTuple):
    """A call that reads a parameter, and the default that stands in it."""

    name: str
    default: Bound | None


class Default(NamedTuple):
    """The parameter that a list is, and what it is as long as nobody sets that."""

    name: str
    read: Bound


class ListDefaults:
    """Finds the list that a parameter is by default."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def elements(self, expr: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the elements of the default of the parameter that a list is; none where not all are known."""
        listed = column(expr, ()).listed if expr is not None and env.func.file.language == "python" else expr
        default = self._default(listed, env)
        return self._told(default, self._folded(default, env)) if default is not None else ()

    def part(self, expr: Expr | None, place: tuple[int, ...], env: Env) -> tuple[Value, ...]:
        """Return what a part of each element is by default: `b` in `for a, b in zip(ids, names)`.

        Parts of several elements belong to parts beside them, so each is one of all.
        """
        found = column(expr, place) if expr is not None and env.func.file.language == "python" else None
        if found is None or found.place:
            return ()
        values = self.elements(found.listed, env)
        return values if len(values) < 2 else lowered(values, "one_of")

    def element(self, expr: Expr | None, env: Env, at: object) -> tuple[Value, ...]:
        """Return what the element at an index is by default; none of a table, nor at an index that is not known."""
        default = self._default(expr, env) if isinstance(at, int) else None
        if default is None or self.folder.tables.entries(default.read.expr, default.read.env) is not None:
            return ()
        chosen = part_of(self._folded(default, env), at) if isinstance(at, int) else None
        return self._told(default, [chosen]) if isinstance(chosen, tuple) else ()

    def _default(self, expr: Expr | None, env: Env) -> Default | None:
        read = self._read(expr, env) if expr is not None else None
        if read is None or self.folder.reads.is_given_instead(read.name, self.folder.parameters.owners(env)):
            return None
        default = self._declared(read.name, env) or read.default
        return Default(read.name, default) if default is not None else None

    def _folded(self, default: Default, env: Env) -> list[tuple[Value, ...]]:
        """What each element may be; nothing where not all are known."""
        items = self.folder.lists.items(default.read.expr, default.read.env.deeper(env.depth + 1)) or ()
        values = [self.folder.lists.fold(item, env) for item in items]
        return values if all(value.text for each in values for value in each) else []

    def _told(self, default: Default, chosen: Sequence[tuple[Value, ...]]) -> tuple[Value, ...]:
        return set_by(default.name, lowered([value for each in chosen for value in each], "default"))

    def _declared(self, name: str, env: Env) -> Bound | None:
        """The default that the class or the file at hand declares."""
        found = self.folder.reads.default(name, env.func.file.package, self.folder.parameters.owners(env))
        return Bound(*found) if isinstance(found, tuple) else None

    def _read(self, expr: Expr, env: Env) -> Read | None:
        """The parameter that a list is: what a variable is read into and nobody changed, or what one call gives."""
        if self._is_changed(expr, env):
            return None
        names = {value.parameter for value in self.folder.fold(expr, env) if value.parameter}
        made = self.folder.origins.makers(expr, env) if isinstance(expr, Name | Member) else [Bound(expr, env)]
        found = self._of_call(made[0]) if made and len(made) == 1 else None
        if found is not None or len(names) != 1:
            return found
        return Read(names.pop(), None)

    def _is_changed(self, expr: Expr, env: Env) -> bool:
        """Whether the function at hand changes a list, or others may that run before or beside it."""
        ways = self.folder.flow.ways(expr, env)
        if ways or not isinstance(expr, Name | Member):
            return any(held.how in _CHANGED for way in ways for held in way)
        lasting = {held.how for held, _ in self.folder.lists.sources(expr, env)} - {"lost"}  # a read need not set it
        return not lasting.isdisjoint(_CHANGED) or self.folder.lists.is_others(expr, env)

    def _of_call(self, made: Bound) -> Read | None:
        call: Expr = made.expr
        while (inner := _value_of(call)) is not None:
            call = inner
        if isinstance(call, Name | Member) and call is not made.expr:  # of which it is a copy
            deeper = made.env.deeper(made.env.depth + 1)
            return self._read(call, deeper) if deeper.depth <= MAX_DEPTH else None
        read = self.folder.reads.read(invocation_of(call, made.env)) if isinstance(call, Call) else None
        if read is None:
            return None
        names = self.folder.fold(read.name, made.env)
        if len(names) != 1 or names[0].confidence == "pattern":
            return None
        return Read(names[0].text, Bound(read.default, made.env) if read.default is not None else None)


def _value_of(expr: Expr) -> Expr | None:
    """What an expression takes the value of, or copies: `it.value`, `parameter.as_string_array()`, `list(it)`."""
    if isinstance(expr, Call) and isinstance(expr.callee, Name) and expr.callee.id in _COPIES:
        return expr.args[0] if len(expr.args) == 1 and not expr.keywords else None
    taken = expr.callee if isinstance(expr, Call) else expr
    return taken.base if isinstance(taken, Member) and taken.name in _UNWRAPPING else None
