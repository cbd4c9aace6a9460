"""Calls of Python that get the object at hand, or a method of it: which of its members they may change."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Lambda, Member, Name

from ecm_extract.infer.library_calls import calls_of
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import children, given_to

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class GivenItself:
    """Finds them, where what gets the object shows all that it does to it."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def changed(self, call: Call, func: Func, this: Cls | None) -> Set[str] | None:
        """Return the members, or fields of them, that a call may change, by key; None where that is not known."""
        if func.file.language != "python" or any(_gives_itself(value) for _, value in call.keywords):
            return None
        found: set[str] = set()
        for at, arg in enumerate(call.args):
            changed = self._by(arg, at, call, func, this)
            if changed is None:
                return None
            found |= changed
        return found

    def _by(self, arg: Expr, at: int, call: Call, func: Func, this: Cls | None) -> Set[str] | None:
        if arg == THIS:
            callee = self.folder.flow.target(call, func, len(func.fact.body))
            known = callee is not None and callee.cls is None and at < len(callee.fact.params)
            return self._by_function(callee, callee.fact.params[at].name) if callee is not None and known else None
        if isinstance(arg, Member) and is_own_member(arg) and this is not None:
            methods = self._methods(arg.name, this)
            calling = isinstance(call.callee, Name) and last_name(call.callee.id) in calls_of("python").calling
            if methods:
                return self._by_methods(methods, this) if calling else None
        return frozenset() if not _gives_itself(arg) else None

    def _methods(self, name: str, this: Cls) -> list[Func]:
        return [each for entry in self.folder.program.related(this) for each in entry.methods if each.fact.name == name]

    def _by_methods(self, methods: list[Func], this: Cls) -> Set[str] | None:
        found: set[str] = set()
        for each in methods:
            members = self.folder.methods.members(each, this)
            if members is None:
                return None
            found |= members
        return found

    def _by_function(self, func: Func, name: str) -> Set[str] | None:
        """The members that a function gives something by their names, and does nothing else with the object."""
        outline = self.folder.flow.outline(func)
        calls = (call for group in func.calls for call in group)
        handed = any(_names(arg, name) for call in calls for arg in given_to(call))
        kept = any(entry.value == Name(name) for entry in func.fact.body)
        inner = any(name in self.folder.shifting.names(each) for each in self.folder.nesting.inner(func))
        if handed or kept or inner or name in outline.changes or self.folder.methods.parameters.is_hidden(func, name):
            return None
        return frozenset(key.removeprefix(name) for key in outline.changes if key.startswith(f"{name}."))


def _gives_itself(expr: Expr) -> bool:
    """Whether an argument has the object at hand, or a method of it, other than to ask it for a member."""
    if expr == THIS or isinstance(expr, Lambda):
        return True
    if is_own_member(expr):
        return False
    return any(map(_gives_itself, children(expr)))


def _names(expr: Expr, name: str) -> bool:
    return any(each == Name(name) for each in _parts(expr))


def _parts(expr: Expr) -> Iterator[Expr]:
    yield expr
    for part in children(expr):
        yield from _parts(part)
