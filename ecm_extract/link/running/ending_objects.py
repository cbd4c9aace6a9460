"""Variables of C++ that objects change when they end: their destructors write to what they were made with.

Source: [class.dtor] of the C++ standard. When an object ends is not followed: from the call on that makes it one may
read what its destructor left, so that nothing is proved of such a variable in the function that makes the object.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.containers import parts_of_elements
from ecm_extract.link.code.pointed import pointed
from ecm_extract.link.code.spelling import by_value, pointee, template_arguments
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_MARK: Final = "~"


class EndingObjects:
    """Finds them; each class is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._acting: dict[Cls, bool] = {}
        self._any: bool | None = None

    def changed(self, func: Func) -> Set[str]:
        """Return the variables, by key, that objects change when they end which a function makes."""
        if func.file.language != "cpp" or not self._any_acts():
            return frozenset()
        effects = self.folder.flow.effects(func)
        found = (
            effects.root(arg)
            for at, calls in enumerate(func.calls)
            for call in calls
            for arg in self._of(call, func, at)
        )
        return frozenset(found) - {""}

    def _any_acts(self) -> bool:
        """Whether the destructor of any class writes to what its members lead to."""
        if self._any is None:
            self._any = False  # who asks in a circle
            classes = [cls for group in self.folder.program.classes.values() for cls in group]
            self._any = any(self.acts(cls) for cls in classes)
        return self._any

    def _of(self, call: Call, func: Func, at: int) -> Iterator[Expr]:
        """Yield the variables, or those whose address is given, that a call gives an object which acts in its end."""
        given = [arg.operands[0] if isinstance(arg, Op) and is_address(arg) else arg for arg in call.args]
        variables = {at: arg for at, arg in enumerate(given) if isinstance(arg, Name | Member)}
        env = Env(func, at, this=func.cls)
        if variables and any(self._acts_as(written, env) for written in self._made(call, env)):
            yield from variables.values()
        elif variables and isinstance(call.callee, Member):
            yield from (variables[at] for at in self._kept(call, call.callee.base, env) if at in variables)

    def _kept(self, call: Call, base: Expr, env: Env) -> Iterator[int]:
        """Yield the places of the arguments that a method of such an object keeps in it."""
        if self._acts_as(pointee(self.folder.objects.type_of(base, env)), env):
            yield from (kept.at for kept in self.folder.kept_references.of(call, env))

    def _made(self, call: Call, env: Env) -> Iterator[str]:
        """Yield the types of which a call may make an object: that of its own, of its result, of what it adds to."""
        yield pointed(call)
        yield from call.types
        if isinstance(call.callee, Name):
            yield call.callee.id
            yield from self._parts(self.folder.objects.type_of(call, env))
        elif isinstance(call.callee, Member):
            yield from self._parts(self.folder.objects.type_of(call, env))
            yield from self._elements(pointee(self.folder.objects.type_of(call.callee.base, env)))

    def _parts(self, written: str) -> Iterator[str]:
        yield pointee(written)
        yield from self._elements(written)

    def _elements(self, written: str) -> Iterator[str]:
        """Yield the types of what an object holds that adds to itself; a call on an object makes no other one."""
        yield from map(pointee, parts_of_elements(written) or template_arguments(written))

    def _acts_as(self, written: str, env: Env) -> bool:
        cls = self._class(written, env)
        return cls is not None and self.acts(cls)

    def _class(self, written: str, env: Env) -> Cls | None:
        return self.folder.objects.class_written(written, env) if written else None

    def acts(self, cls: Cls) -> bool:
        """Tell whether an object of a class writes, when it ends, to what it was made with: it, or a part of it."""
        known = self._acting.get(cls)
        if known is None:
            self._acting[cls] = False  # who asks in a circle
            known = self._acting[cls] = cls.file.language == "cpp" and self._acts(cls)
        return known

    def _acts(self, cls: Cls) -> bool:
        lineage = self.folder.program.ancestry(cls)
        if any(self.acts(base) for base in lineage[1:]) or self._writes(cls):
            return True
        env = Env(cls.methods[0], this=cls) if cls.methods else None
        parts = (field.type for field in cls.fact.fields if by_value(field.type) or pointee(field.type) != field.type)
        return env is not None and any(self.acts(part) for each in parts if (part := self._class(each, env)))

    def _writes(self, cls: Cls) -> bool:
        """Whether the destructor of a class, or a method that it calls on itself, changes what a member leads to."""
        pending = [method for method in cls.methods if method.fact.name.startswith(_MARK)]
        seen = set(pending)
        while pending:
            method = pending.pop()
            if any(self.folder.kept_references.writes(name, method, cls) for name in cls.fields):
                return True
            names = {call.callee.id for group in method.calls for call in group if isinstance(call.callee, Name)}
            called = {each for each in cls.methods if each.fact.name in names} - seen
            seen |= called
            pending += called
        return False
