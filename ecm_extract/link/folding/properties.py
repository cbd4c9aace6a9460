"""Properties of Python: reading `self.base` runs the function that is decorated so.

docs.python.org: "Built-in Functions" (property), functools (cached_property), Data model ("Invoking Descriptors").
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.link.code.decorators import is_kept_property, is_property, sets_property
from ecm_extract.link.code.own import is_super
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.values import Value, alternatives, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ANY = frozenset({"__getattr__", "__getattribute__"})


class PropertyFolder:
    """Finds the functions behind attributes, and folds what they give."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._getters: dict[tuple[Cls, str], Func | None] = {}

    def value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what reading a property gives; empty of other members."""
        read = self.read(expr, env)
        if read is None:
            return ()
        asked = ("property", expr, env.func, env.at, env.state, env.made, env.this)
        values = self.folder.guarded(asked, expr.name, lambda: self._returned(read, env.before(env.at)))
        return alternatives((*values, unknown(expr.name))) if self._is_kept(expr, env) else values

    def _returned(self, read: Call, env: Env) -> tuple[Value, ...]:
        return self.folder.returns.values(invocation_of(read, env), env)

    def read(self, expr: Expr, env: Env) -> Call | None:
        """Return the call that reading a property is; None of other members."""
        if env.func.file.language != "python" or not isinstance(expr, Member):
            return None
        if expr.name not in self.folder.program.functions:
            return None
        return Call(expr, ()) if self._getter(expr, env) is not None else None

    def through(self, expr: Member, env: Env) -> Member:
        """Return a field of the object that a property only hands on (`self.model.name`), as a field of that object."""
        base = expr.base
        if not isinstance(base, Member) or self.read(base, env) is None:
            return expr
        kept = self._handed_on(base, env)
        return expr if kept is None else Member(Member(self.through(base, env).base, kept), expr.name)

    def _handed_on(self, expr: Member, env: Env) -> str | None:
        """The member that a property gives and nothing else, which no derived class has otherwise."""
        getter = self._getter(expr, env)
        body = getter.fact.body if getter is not None else ()
        given = body[0].value if len(body) == 1 and body[0].kind == "return" else None
        if getter is None or getter.cls is None or is_kept_property(getter):
            return None
        if not isinstance(given, Member) or given.base != THIS:
            return None
        others = self.folder.program.derived(getter.cls)
        return None if any(_has(entry, expr.name) for entry in others) else given.name

    def changed_by_reading(self, name: str, env: Env) -> bool:
        """Tell whether reading some property of the object at hand gives a member of it something."""
        cls = env.this or env.func.cls
        if cls is None or cls.file.language != "python" or is_property(env.func):
            return False
        return any(is_property(each) for entry in self._lineage(cls) for each in self._changing(name, entry))

    def _lineage(self, cls: Cls) -> tuple[Cls, ...]:
        return (*self.folder.program.ancestry(cls), *self.folder.program.derived(cls))

    def _changing(self, name: str, cls: Cls) -> Iterator[Func]:
        """The methods of a class that give a member something."""
        changing = self.folder.scope.changing(name, cls)
        return (each for each in changing if f".{name}" in self.folder.flow.outline(each).changes)

    def read_by(self, func: Func, this: Cls | None) -> Iterator[Func]:
        """Yield the properties of the object at hand that a method may read."""
        if this is None or this.file.language != "python":
            return
        for name in self.folder.shifting.names(func):
            getter = self._of_class(name, this) if name in self.folder.program.functions else None
            if getter is not None:
                yield getter

    def _is_kept(self, expr: Member, env: Env) -> bool:
        """Whether what is read may be what was kept when somebody read it before something changed."""
        getter = self._getter(expr, env)
        return getter is not None and is_kept_property(getter) and self.folder.methods.depends(getter, getter.cls)

    def _getter(self, expr: Member, env: Env) -> Func | None:
        cls = self._class_of(expr.base, env)
        return self._of_class(expr.name, cls) if cls is not None else None

    def _class_of(self, base: Expr, env: Env) -> Cls | None:
        own = env.func.cls or env.this
        if is_super(base) and own is not None:
            first = base.args[0] if isinstance(base, Call) and base.args else None
            return next(iter(self.folder.program.bases(own)), None) if first is None else None
        if isinstance(base, Name) and base.id == "super":
            return None
        made = self.folder.states.instance(base, env) if base != THIS else None
        return made.cls if made is not None else self.folder.objects.class_of(base, env)

    def _of_class(self, name: str, cls: Cls) -> Func | None:
        known = self._getters.get((cls, name))
        if known is None and (cls, name) not in self._getters:
            known = self._getters[cls, name] = self._found(name, cls)
        return known

    def _found(self, name: str, cls: Cls) -> Func | None:
        """The property of a name, where the nearest class that has the name has nothing else, and nobody sets it."""
        lineage = self.folder.program.ancestry(cls)
        owner = next((entry for entry in lineage if _has(entry, name)), None)
        named = [each for each in owner.methods if each.fact.name == name] if owner is not None else []
        found = [each for each in named if not sets_property(each)]
        if owner is None or name in owner.fields or len(found) != 1 or not is_property(found[0]):
            return None
        if self._is_given(found[0], cls, may_be_set=len(named) > 1):
            return None
        asked = any(each.fact.name in _ANY for entry in lineage for each in entry.methods)
        return None if asked or self.folder.python_fields.any_is_given(cls) else found[0]

    def _is_given(self, getter: Func, cls: Cls, may_be_set: bool) -> bool:
        """Whether somebody gives the attribute something; without a setter only the class can be given another one."""
        name = getter.fact.name
        if any(self.folder.scope.members(name, entry) for entry in self._lineage(cls)):
            return True
        is_open = may_be_set or is_kept_property(getter)
        given = self.folder.scope.assigned_outside(name, "python") if is_open else ()
        return bool(given) or self.folder.redefined.is_replaced(getter)


def _has(cls: Cls, name: str) -> bool:
    return name in cls.fields or any(each.fact.name == name for each in cls.methods)
