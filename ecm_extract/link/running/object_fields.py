"""Fields that others than methods of an object give something: methods find them as their callers left them.

`topic.name = "a"; topic.full();` reads in `full` what stands in `topic.name` where that is called.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member

from ecm_extract.infer.held import Held
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.spelling import by_value
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.object_states import is_own

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ObjectFields:
    """Tells which methods read such fields; each method is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._reading: dict[tuple[Func, Cls], bool] = {}
        self._given: dict[tuple[str, Cls], bool] = {}

    def at_caller(self, key: str, env: Env) -> Held | None:
        """Return a field of the object at hand as who calls the method has it; None where that is not known.

        Args:
            key: the field (see `places`).
            env: a place in the method.
        """
        caller = env.caller
        if caller is None or is_own(caller.expr):
            return None
        path = key.split(".")[1:]
        followed = env.made is None or len(path) > 1 or self.is_given(path[0], env.this or env.func.cls)
        return Held("value", key, _within(caller.expr, path), caller.env) if followed else None

    def is_known(self, env: Env) -> bool:
        """Tell whether a method runs on an object that somebody wrote, through all that call it on the same one."""
        caller: Bound | None = env.caller
        while caller is not None and is_own(caller.expr):
            caller = caller.env.caller
        return caller is not None

    def is_given(self, name: str, cls: Cls | None) -> bool:
        """Tell whether others than the methods of a class may give a field of its objects something."""
        if cls is None:
            return False
        known = self._given.get((name, cls))
        if known is None:
            known = self._given[name, cls] = self._is_given(name, cls)
        return known

    def _is_given(self, name: str, cls: Cls) -> bool:
        if cls.file.language == "python":
            return bool(self.folder.scope.assigned_outside(name, "python"))
        owner = next((entry for entry in self.folder.program.ancestry(cls) if name in entry.fields), None)
        return owner is not None and self.folder.given_fields.is_given(name, owner)

    def reads(self, func: Func, this: Cls | None) -> bool:
        """Tell whether a method reads such a field of its object, or of an object that is a part of it."""
        cls = this or func.cls
        if cls is None or func.is_constructor:
            return False
        known = self._reading.get((func, cls))
        if known is None:
            self._reading[func, cls] = False  # who asks in a circle
            known = self._reading[func, cls] = self._reads(func, cls)
        return known

    def _reads(self, func: Func, cls: Cls) -> bool:
        names = self.folder.shifting.names(func)
        if any(self.is_given(name, cls) for name in names):
            return True
        if cls.file.language == "python":
            return any(self.reads(method, method.cls) for method in self._of_parts(func))
        return any(self._is_open(name, cls, func) for name in names)

    def _is_open(self, name: str, cls: Cls, func: Func) -> bool:
        """Whether a member of C++ is an object with such fields."""
        written = self.folder.scope.member_type(name, cls)
        part = self.folder.objects.class_written(written, Env(func)) if by_value(written) else None
        return part is not None and part is not cls and any(self.is_given(field, part) for field in part.fields)

    def _of_parts(self, func: Func) -> Iterator[Func]:
        """The methods that a method of Python may call of what members of its object are."""
        for name in dict.fromkeys(_called_of_parts(func)):
            yield from (each for each in self.folder.program.seen_functions(name, func.file) if each.cls is not None)


def _called_of_parts(func: Func) -> Iterator[str]:
    calls: Iterator[Call] = (call for group in func.calls for call in group)
    for callee in (call.callee for call in calls):
        if isinstance(callee, Member) and is_own_member(callee.base):
            yield callee.name


def _within(expr: Expr, path: Sequence[str]) -> Expr:
    for name in path:
        expr = Member(expr, name)
    return expr
