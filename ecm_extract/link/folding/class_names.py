"""What a class of Python is called, and what it has: `type(self).__name__`, `Camera.__name__`, `type(self).NAMES`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeVar

from ecm_parsers.source.expr import THIS, Expr, Member, Name

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.own_class import is_own_class
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, literal, parameter

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_Expr = TypeVar("_Expr", bound=Expr)
CLASS_NAME: Final = "class_name"
"""What the name of a class is called where it is not known."""
_ASKED: Final = "__name__"


class ClassNames:
    """Folds the names of classes."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return the name of a class; empty of other members."""
        if expr.name != _ASKED or env.func.file.language != "python":
            return ()
        if is_own_class(expr.base, env.func):
            return self._at_hand(env)
        named = dotted_name(expr.base)
        cls = self.folder.program.class_named(named, env.func.file, env.scope) if named else None
        rebound = isinstance(expr.base, Name) and bool(self.folder.flow.ways(expr.base, env))
        return (_named(cls),) if cls is not None and not rebound and named not in env.func.given else ()

    def by_object(self, expr: _Expr, env: Env) -> _Expr | Member:
        """Return `self.NAMES` for `type(self).NAMES`, of what no method gives the object itself; others as they are."""
        if not isinstance(expr, Member) or expr.base == THIS or not is_own_class(expr.base, env.func):
            return expr
        cls = env.this or env.func.cls
        program, flow = self.folder.program, self.folder.flow
        lineage = (*program.ancestry(cls), *program.derived(cls)) if cls is not None else ()
        methods = (each for entry in lineage for each in self.folder.scope.changing(expr.name, entry))
        given = any(f".{expr.name}" in flow.outline(each).given for each in methods)
        return expr if given or expr.name == _ASKED else Member(THIS, expr.name)

    def _at_hand(self, env: Env) -> tuple[Value, ...]:
        """The class of the object at hand; of which no more is known it may be any that derives from it."""
        cls = env.this or env.func.cls
        if cls is None:
            return ()
        exact = env.made is not None and env.made.is_one and env.made.cls is cls
        if not exact and self.folder.program.derived(cls):
            return (parameter(CLASS_NAME, made=True),)
        return (_named(cls),)


def _named(cls: Cls) -> Value:
    return literal(cls.fact.name)._replace(confidence="folded")
