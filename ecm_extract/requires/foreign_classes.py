"""C++: which classes of other packages the objects and the bases of a function are of, each looked up once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from ecm_parsers.source.expr import THIS, Expr

from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import dotted
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects

_LANGUAGE: Final = "std"
_KNOWN: Final = frozenset({_LANGUAGE, "boost"})


class ForeignClasses:
    """Classes of other packages that the objects of one function are of, remembered by how they are written."""

    def __init__(self, func: Func, objects: Objects) -> None:
        self._func, self._objects = func, objects
        self._env = Env(func)
        self._by_object: dict[str, str] = {}
        self._by_type: dict[str, str] = {}

    def of(self, expr: Expr) -> str:
        """Return the qualified class of an object; empty for what is not declared, or is the own package's."""
        written = dotted(expr)
        return "" if written is None or expr == THIS else self._remembered(written, expr)

    def declared(self, expr: Expr) -> str:
        """Return the class of any object whose type is declared, such as an element of a list."""
        written = dotted(expr)
        return self._of_type(expr) if written is None else self._remembered(written, expr)

    def _remembered(self, written: str, expr: Expr) -> str:
        known = self._by_object.get(written)
        if known is None:
            known = self._by_object[written] = self._of_type(expr)
        return known

    def _of_type(self, expr: Expr) -> str:
        written = self._objects.type_of(expr, self._env)
        known = self._by_type.get(written)
        if known is None:
            known = self._by_type[written] = self._foreign(written)
        return known

    def _foreign(self, written: str) -> str:
        func, program = self._func, self._objects.program
        if not written or "auto" in written.split():
            return ""
        cls: Cls | None = self._objects.class_written(written, self._env)
        if cls is not None:
            return cls.qualified if cls.file.package != func.file.package else ""
        name = program.canonical(plain(pointee(written)), func.file, func.fact.scope)
        name = program.spelled_out(plain(pointee(name)), func.file).removeprefix("::")
        return name if "::" in name and name.partition("::")[0] != _LANGUAGE else ""


class Inherited:
    """What those methods of one class that stand in a package have of base classes that other packages have.

    Attributes:
        bases: those classes, qualified where the tree shows them.
    """

    def __init__(self, cls: Cls | None, package: str, objects: Objects) -> None:
        self._cls, self._package, self._objects = cls, package, objects
        self.bases = foreign_bases(cls, objects)
        self._own: frozenset[str] | None = None

    def is_own(self, name: str) -> bool:
        """Tell whether a member is of the own package."""
        if self._own is None:
            self._own = frozenset(self._own_names())
        return name in self._own

    def _own_names(self) -> list[str]:
        entries = self._objects.program.ancestry(self._cls) if self._cls is not None else ()
        own = [entry for entry in entries if entry.file.package == self._package]
        return [name for entry in own for name in (*entry.fields, *(method.fact.name for method in entry.methods))]


def foreign_bases(cls: Cls | None, objects: Objects) -> Sequence[str]:
    """Return the base classes of a class that other packages have, qualified where the tree shows them."""
    if cls is None:
        return ()
    found: dict[str, None] = {}
    for name in objects.program.base_names(cls):
        base = objects.program.class_named(name, cls.file, cls.qualified)
        if base is None or base.file.package != cls.file.package:
            found[base.qualified if base is not None else name] = None
    return [name for name in found if name.partition("::")[0] not in _KNOWN]
