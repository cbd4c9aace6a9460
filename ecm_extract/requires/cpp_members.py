"""C++: methods called on, and members read of, objects whose class another package provides.

The class of an object is told by its declaration: a parameter, a local, a member of the own class, the class itself
and what it derives from. What is not declared in the tree (`auto` of a foreign call) has no class here.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.handles import verbs
from ecm_checker.hub.requirement import Given, Requirement
from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.env import Env
from ecm_extract.link.objects import Objects
from ecm_extract.link.spelling import plain, pointee
from ecm_extract.link.units import Cls, Func
from ecm_extract.link.walk import dotted, expressions
from ecm_extract.requires.place import Place, required

_OWN: str = "std"
_THIS: Final = Name("this")


class _Touched(msgspec.Struct, frozen=True):
    """A member of an object of a class, and with how many arguments it is called; -1 where it is read."""

    owner: str
    name: str
    count: int = -1


def member_requirements(objects: Objects) -> Iterator[tuple[str, Requirement]]:
    """Yield package and requirement; of one member that a file touches alike in several lines, one."""
    for functions in objects.program.functions.values():
        for func in functions:
            if func.file.language == "cpp" and func.fact.body:
                for found in _of_function(func, objects):
                    yield func.file.package, found


def _of_function(func: Func, objects: Objects) -> Iterator[Requirement]:
    lines: dict[_Touched, dict[int, None]] = {}
    handled: dict[str, int] = {}
    classes = ForeignClasses(func, objects)
    for statement in func.fact.body:
        called: set[int] = set()
        for expr, line in expressions(statement):
            if isinstance(expr, Call) and isinstance(expr.callee, Member):
                called.add(id(expr.callee))
                if expr.callee.name.startswith(verbs()) and expr.callee.base != _THIS:
                    handled.setdefault(expr.callee.name, line)
                owner = classes.of(expr.callee.base)
                touched = _Touched(owner, expr.callee.name, len(expr.args))
            elif isinstance(expr, Member) and id(expr) not in called:
                owner = classes.of(expr.base)
                touched = _Touched(owner, expr.name)
            else:
                continue
            if owner:
                lines.setdefault(touched, {})[line] = None
    for touched, found in lines.items():
        yield _required(touched, func, tuple(found))
    for name, line in handled.items():
        # of whichever class: who gives back mostly holds the object in a type that is not told
        yield required("handles", name, Place(func.file.path, line, f"file {func.file.path}"), "unknown")


def _required(touched: _Touched, func: Func, lines: tuple[int, ...]) -> Requirement:
    place = Place(func.file.path, lines[0], f"file {func.file.path}")
    evidence = tuple(Evidence(func.file.path, line) for line in lines)
    if touched.count < 0:
        return required("reads_member", touched.name, place, owner=touched.owner, evidence=evidence)
    given = Given(count=touched.count)
    return required("calls_method", touched.name, place, owner=touched.owner, given=given, evidence=evidence)


class ForeignClasses:
    """Classes of other packages that the objects of one function are of, remembered by how they are written."""

    def __init__(self, func: Func, objects: Objects) -> None:
        self._func, self._objects = func, objects
        self._known: dict[str, str] = {}

    def of(self, expr: Expr) -> str:
        """Return the qualified class of an object; empty for what is not declared, or is the own package's."""
        written = dotted(expr)
        if written is None or expr == Name("this"):
            return ""
        if written not in self._known:
            self._known[written] = self.declared(expr)
        return self._known[written]

    def declared(self, expr: Expr) -> str:
        """Return the class of any object whose type is declared, such as an element of a list."""
        return self._foreign(self._objects.type_of(expr, Env(self._func)))

    def _foreign(self, written: str) -> str:
        func, program = self._func, self._objects.program
        if not written or "auto" in written.split():
            return ""
        cls: Cls | None = self._objects.class_written(written, Env(func))
        if cls is not None:
            return cls.qualified if cls.file.package != func.file.package else ""
        name = program.canonical(plain(pointee(written)), func.file, func.fact.scope)
        name = plain(pointee(name)).removeprefix("::")
        return name if "::" in name and name.partition("::")[0] != _OWN else ""
