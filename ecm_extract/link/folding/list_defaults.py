"""Elements of lists that parameters are, as long as nobody sets these."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.running.env import Bound, Env, invocation_of
from ecm_extract.link.running.values import Value, lowered, set_by
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_UNWRAPPING: Final = shipped_names("link/code/library_values.toml", "parameter_values")

_CHANGED: Final = frozenset({"changed", "stored", "out", "handed", "reached", "after", "lost"})
"""What becomes of a list that is not, or need not be, what it was read as."""


class Read(NamedTuple):
    """A call that reads a parameter, and the default that stands in it."""

    name: str
    default: Bound | None


class ListDefaults:
    """Finds the list that a parameter is by default."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def elements(self, expr: Expr | None, env: Env) -> tuple[Value, ...]:
        """Return the elements of the default of the parameter that a list is; none where not all are known."""
        read = self._read(expr, env) if expr is not None else None
        if read is None or self.folder.reads.is_given_instead(read.name, self.folder.parameters.owners(env)):
            return ()
        default = self._declared(read.name, env) or read.default
        if default is None:
            return ()
        items = self.folder.lists.items(default.expr, default.env.deeper(env.depth + 1)) or ()
        values = [value for item in items for value in self.folder.lists.fold(item, env)]
        return set_by(read.name, lowered(values, "default")) if all(value.text for value in values) else ()

    def _declared(self, name: str, env: Env) -> Bound | None:
        """The default that the class or the file at hand declares."""
        found = self.folder.reads.default(name, env.func.file.package, self.folder.parameters.owners(env))
        return Bound(*found) if isinstance(found, tuple) else None

    def _read(self, expr: Expr, env: Env) -> Read | None:
        """The parameter that a list is: what a variable is read into and nobody changed, or what one call gives."""
        if any(held.how in _CHANGED for way in self.folder.flow.ways(expr, env) for held in way):
            return None
        names = {value.parameter for value in self.folder.fold(expr, env) if value.parameter}
        made = self.folder.origins.makers(expr, env) if isinstance(expr, Name | Member) else [Bound(expr, env)]
        found = self._of_call(made[0]) if made and len(made) == 1 else None
        if found is not None or len(names) != 1:
            return found
        return Read(names.pop(), None)

    def _of_call(self, made: Bound) -> Read | None:
        call: Expr = made.expr
        while (inner := _value_of(call)) is not None:
            call = inner
        read = self.folder.reads.read(invocation_of(call, made.env)) if isinstance(call, Call) else None
        if read is None:
            return None
        names = self.folder.fold(read.name, made.env)
        if len(names) != 1 or names[0].confidence == "pattern":
            return None
        return Read(names[0].text, Bound(read.default, made.env) if read.default is not None else None)


def _value_of(expr: Expr) -> Expr | None:
    """The parameter whose value an expression takes: `parameter.value`, `parameter.as_string_array()`."""
    taken = expr.callee if isinstance(expr, Call) else expr
    return taken.base if isinstance(taken, Member) and taken.name in _UNWRAPPING else None
