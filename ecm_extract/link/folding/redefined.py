"""Methods that a call may run in the place of the one found: those of derived classes, and what a class is given."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.early_binding import is_virtual
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.known_callers import Calling

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_CALLERS: Final = 50
"""Functions through which a constructor is sought that calls a method."""


class Redefined:
    """Tells where another method may run than the one that the class at hand has."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._replaced: dict[tuple[Cls, str], bool] = {}
        self._making: dict[Func, bool] = {}

    def may_be(self, callee: Func, call: Invocation, env: Env) -> bool:
        """Tell whether a call on the object at hand may run something else than the method that was found."""
        cls = env.this or env.func.cls
        if callee.cls is None or cls is None or callee.is_constructor or call.receiver not in {None, THIS}:
            return callee.cls is not None and not callee.is_constructor and self.is_replaced(callee)
        if env.func.file.language == "cpp":
            return self._of_cpp(callee, cls, env)
        concrete = env.made is not None and bool(env.made.args or env.made.types or env.made.maker)
        derived = () if concrete else self.folder.program.derived(cls)
        return self.is_replaced(callee) or any(_redefines(entry, callee.fact.name) for entry in derived)

    def open_call(self, expr: Expr | None, env: Env) -> str:
        """Return the name of the method that an expression calls, where another one may run; empty of others."""
        read = self.folder.properties.read(expr, env) if isinstance(expr, Member) else expr
        call = invocation_of(read, env) if isinstance(read, Call) else None
        callee = self.folder.returns.meant(call, env) if call is not None else None
        return callee.fact.name if call is not None and callee is not None and self.may_be(callee, call, env) else ""

    def _of_cpp(self, callee: Func, cls: Cls, env: Env) -> bool:
        """A constructor, and what it calls, has the methods of its own class: [class.cdtor]."""
        if env.func.is_constructor or not is_virtual(callee, self.folder.program):
            return False
        static = env.func.cls
        if static is not None and callee.cls not in self.folder.program.ancestry(static):
            return self._is_called_in_making(env.func)
        concrete = env.made is not None and bool(env.made.args or env.made.types or env.made.maker)
        derived = () if concrete else self.folder.program.derived(cls)
        return any(_redefines(entry, callee.fact.name) for entry in derived)

    def _is_called_in_making(self, func: Func) -> bool:
        """Whether a constructor of its class, which cannot know derived ones, may call a method."""
        known = self._making.get(func)
        if known is None:
            known = self._making[func] = any(
                each.is_constructor and each.cls is func.cls for each in self._around(func)
            )
        return known

    def _around(self, func: Func) -> Iterator[Func]:
        """The functions that call one, directly or through others."""
        pending, seen = [func], {func}
        while pending and len(seen) < MAX_CALLERS:
            for call, _ in self._calls_of(pending.pop()):
                if call.func not in seen:
                    seen.add(call.func)
                    pending.append(call.func)
                    yield call.func

    def _calls_of(self, func: Func) -> Iterable[Calling]:
        find = self.folder.states.callers.find
        return find(func) if find is not None else ()

    def is_replaced(self, method: Func) -> bool:
        """Tell whether somebody gives a class of Python something else than a method: `Base.topic = other`."""
        cls, name = method.cls, method.fact.name
        if cls is None or cls.file.language != "python":
            return False
        known = self._replaced.get((cls, name))
        if known is None:
            known = self._replaced[cls, name] = self._is_given(name, cls)
        return known

    def _is_given(self, name: str, cls: Cls) -> bool:
        program = self.folder.program
        named = {each.fact.name for each in (*program.ancestry(cls), *program.derived(cls))} | {"cls", "__class__"}
        given = self.folder.scope.assigned_outside(name, "python")
        return any(
            program.sees(each.func.file, cls.file) and _names_class(each.statement.target, named) for each in given
        )


def _names_class(target: Expr | None, names: Collection[str]) -> bool:
    """Whether what is assigned is an attribute of a class, by its name, or of what a call gives: `type(self).x`."""
    base = target.base if isinstance(target, Member) else None
    named = base.id if isinstance(base, Name) else base.name if isinstance(base, Member) else ""
    return named in names or (isinstance(base, Call) and base.callee == Name("type"))


def _redefines(cls: Cls, name: str) -> bool:
    """Whether a derived class has something of its own by the name of a method: of Python an attribute, too."""
    assigned = name in cls.fields and cls.fields[name].default is not None
    return assigned or any(each.fact.name == name for each in cls.methods)
