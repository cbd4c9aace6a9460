"""Members that hold different things at different times: only of these does it matter who calls a method, and when."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Member, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.places import target_of
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import expressions

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder
    from ecm_extract.link.running.env import Env


class Shifting:
    """Tells which members shift; each class and each function is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._members: dict[tuple[Cls, str], bool] = {}
        self._passed: dict[tuple[Cls, str], bool] = {}
        self._named: dict[Func, Set[str]] = {}

    def member(self, name: str, cls: Cls) -> bool:
        """Tell whether a member may be given something else after its object was made, or several things before."""
        known = self._members.get((cls, name))
        if known is None:
            known = self._members[cls, name] = self._shifts(name, cls)
        return known

    def is_fixed(self, key: str, env: Env) -> bool:
        """Tell whether nobody gives a member (see `places`) anything else once the constructor at hand made it."""
        cls, name = env.this or env.func.cls, key[1:]
        if cls is None or "." in name or self.member(name, cls):
            return False
        return not self.folder.states.callers.may_be_written_outside(name, env.func)

    def is_passed(self, name: str, cls: Cls) -> bool:
        """Tell whether a member does not shift, but is made of what the constructor gets."""
        known = self._passed.get((cls, name))
        if known is None:
            changes = self._changed(name, cls)
            known = not self.member(name, cls) and any(_names_parameter(method, at) for method, at in changes)
            self._passed[cls, name] = known
        return known

    def _shifts(self, name: str, cls: Cls) -> bool:
        changes = self._changed(name, cls)
        if len(changes) > 1 or self.folder.python_fields.any_is_given(cls):
            return True
        if any(not self._is_of_making(method, at) for method, at in changes) and self._is_begun(name, cls):
            return True
        return any(not self._is_first(f".{name}", method, at) for method, at in changes)

    def _is_of_making(self, method: Func, at: int) -> bool:
        """Whether a statement is taken whenever an object is made, before anybody is called."""
        certain = method.is_constructor and at in self.folder.flow.outline(method).certain
        return certain and not any(method.calls[:at])

    def _is_begun(self, name: str, cls: Cls) -> bool:
        """Whether objects of Python have a member by their class before any method gives it something."""
        lineage = self.folder.program.ancestry(cls) if cls.file.language == "python" else ()
        return any(name in self.folder.begun_objects.attributes.of(each) for each in lineage)

    def _changed(self, name: str, cls: Cls) -> list[tuple[Func, int]]:
        """The statements that change a member, each with its method."""
        program = self.folder.program
        lineage = (*program.ancestry(cls), *program.derived(cls))
        changing = [method for entry in lineage for method in self.folder.scope.changing(name, entry)]
        return [(method, at) for method in changing for at in self._changes(f".{name}", method)]

    def _changes(self, key: str, method: Func) -> Iterator[int]:
        """The statements of a method that change a member; what runs any time later counts as one of its own."""
        outline = self.folder.flow.outline(method)
        yield from (at for at in range(len(method.fact.body)) if key in outline.changed_by(at))
        if key in outline.escaped:
            yield -1

    def _is_first(self, key: str, method: Func, at: int) -> bool:
        """Whether a statement gives a member of an object that is being made a value of its own."""
        if not method.is_constructor or at < 0:
            return False
        effects = self.folder.flow.effects(method)
        statement = method.fact.body[at]
        plain = effects.key(target_of(statement)) == key and not any(effect.key == key for effect in effects.of(at))
        without_target = Statement("do", statement.line, statement.value)
        named = (expr for expr, _ in expressions(without_target) if isinstance(expr, Name | Member))
        return plain and not any(effects.key(expr) == key for expr in named)

    def is_read(self, func: Func, cls: Cls | None) -> bool:
        """Tell whether a function names a member that shifts, of an object of a class."""
        return cls is not None and any(self.member(name, cls) for name in self.names(func))

    def names(self, func: Func) -> Set[str]:
        """Return the names in the body of a function."""
        known = self._named.get(func)
        if known is None:
            parts = (expr for statement in func.fact.body for expr, _ in expressions(statement))
            named = [
                expr.id if isinstance(expr, Name) else expr.name for expr in parts if isinstance(expr, Name | Member)
            ]
            known = self._named[func] = frozenset(named)
        return known


def _names_parameter(method: Func, at: int) -> bool:
    """Whether a statement makes use of a parameter of its function."""
    given = {parameter.name for parameter in method.fact.params}
    return any(isinstance(expr, Name) and expr.id in given for expr, _ in expressions(method.fact.body[at]))
