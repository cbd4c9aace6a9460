"""C++: what a file touches of objects that it reaches through another package: by a base class, a call, a list.

Only the package that declares the way knows what stands at its end, so the owner of such a requirement is the way:
`arm_lib::Arm.joints_` is what the member `joints_` of that class holds, `arm_lib::read()` what the function gives.
Lists and pointers on the way are passed through: a list is touched through its elements.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.requirement import Given, Requirement
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.link.containers import ELEMENT_METHODS
from ecm_extract.link.objects import Objects
from ecm_extract.link.units import Cls, Func
from ecm_extract.link.walk import dotted, expressions
from ecm_extract.requires.cpp_members import ForeignClasses
from ecm_extract.requires.place import Place, required

MAX_STEPS: Final = 6
_SELF: Final = frozenset({"get", "lock", "value"}) | ELEMENT_METHODS
"""Methods of pointers and containers that give what they hold."""
_MACRO: Final = re.compile(r"[A-Z][A-Z0-9_]*")
_OWN: Final = frozenset({"std", "boost"})


"""Said of a member that is gone through to what it holds."""


class _Touched(msgspec.Struct, frozen=True):
    """A member at the end of a way.

    Attributes:
        owner: the way. name: of the member.
        count: with how many arguments it is called; -1 where it is read.
        inside: whether members of what it holds are touched, so that its type counts too.
    """

    owner: str
    name: str
    count: int = -1
    inside: bool = False


def reached_requirements(objects: Objects) -> Iterator[tuple[str, Requirement]]:
    """Yield package and requirement; of one member that a function touches alike in several lines, one."""
    for functions in objects.program.functions.values():
        for func in functions:
            if func.file.language == "cpp" and func.fact.body:
                yield from ((func.file.package, found) for found in _of_function(func, objects))


def _of_function(func: Func, objects: Objects) -> Iterator[Requirement]:
    ways, lines = _Ways(func, objects), dict[_Touched, dict[int, None]]()
    for statement in func.fact.body:
        called: set[int] = set()
        inside: set[int] = set()
        for expr, line in expressions(statement):
            if isinstance(expr, Member):
                inside.add(id(expr.base))
            if isinstance(expr, Call):
                called.add(id(expr.callee))
                found = ways.touched(expr.callee, len(expr.args))
            else:
                found = iter(()) if id(expr) in called else ways.touched(expr)
            for touched in found:
                held = msgspec.structs.replace(touched, inside=id(expr) in inside)
                lines.setdefault(held, {})[line] = None
    scope = func.cls.qualified if func.cls is not None else func.fact.scope
    for touched, at in lines.items():
        yield _required(touched, func, scope, tuple(at))


def _required(touched: _Touched, func: Func, scope: str, lines: tuple[int, ...]) -> Requirement:
    path = func.file.path
    evidence = tuple(Evidence(path, line) for line in lines)
    use = "reads_member" if touched.count < 0 else "calls_method"
    given = _given(touched)
    place = Place(path, lines[0], f"file {path}")
    return required(use, touched.name, place, owner=touched.owner, scope=scope, given=given, evidence=evidence)


def _given(touched: _Touched) -> Given | None:
    if touched.count >= 0:
        return Given(count=touched.count)
    return Given(inside=True) if touched.inside else None


class _Ways:
    """How the objects of one function are reached, where another package knows what they are."""

    def __init__(self, func: Func, objects: Objects) -> None:
        self._func, self._objects = func, objects
        self._classes = ForeignClasses(func, objects)
        self._bases = foreign_bases(func.cls, objects)
        self._given = {parameter.name for parameter in func.fact.params}

    def touched(self, expr: Expr, count: int = -1) -> Iterator[_Touched]:
        """Yield what an expression that is no local touches of another package by a way."""
        name = self._inherited(expr)
        if name:
            yield from (_Touched(base, name, count) for base in self._bases)
        elif isinstance(expr, Member) and not self._is_plain(expr.base):
            yield from (_Touched(way, expr.name, count) for way in self._ways(expr.base))

    def _is_plain(self, expr: Expr) -> bool:
        """Whether the class of an object is told by its declaration, as `cpp_members` reads it."""
        return dotted(expr) is not None and bool(self._classes.of(expr))

    def _inherited(self, expr: Expr) -> str:
        """The name of a member that only a base class of another package can have; empty for any other."""
        if not self._bases:
            return ""
        if isinstance(expr, Member) and expr.base == Name("this"):
            return "" if self._is_own(expr.name) else expr.name
        if not isinstance(expr, Name) or "::" in expr.id or _MACRO.fullmatch(expr.id) or expr.id == "this":
            return ""
        local = expr.id in self._given or expr.id in self._objects.scope.locals_of(self._func)
        return "" if local or self._is_own(expr.id) else expr.id

    def _is_own(self, name: str) -> bool:
        cls, package = self._func.cls, self._func.file.package
        for entry in self._objects.program.ancestry(cls) if cls is not None else ():
            has = name in entry.fields or any(method.fact.name == name for method in entry.methods)
            if has and entry.file.package == package:
                return True
        return False

    def _ways(self, expr: Expr, steps: int = 0) -> Sequence[str]:
        """The ways to an object; none where it is no other package's."""
        if steps > MAX_STEPS:
            return ()
        known = self._classes.declared(expr) if not isinstance(expr, Call) else ""
        if known:
            return (known,)
        name = self._inherited(expr)
        if name:
            return tuple(f"{base}.{name}" for base in self._bases)
        if isinstance(expr, Name):
            return self._assigned(expr.id, steps)
        if isinstance(expr, Op) and expr.op in {"[]", "*", "&"}:
            return self._ways(expr.operands[0], steps + 1)
        if isinstance(expr, Member):
            return tuple(f"{way}.{expr.name}" for way in self._ways(expr.base, steps + 1))
        return self._called(expr.callee, steps) if isinstance(expr, Call) else ()

    def _assigned(self, name: str, steps: int) -> Sequence[str]:
        """By what a local was given: `auto arm = arm_lib::read();`, `for (auto & joint : joints_)`."""
        body = self._func.fact.body
        for at in self._objects.scope.locals_of(self._func).get(name, ()):
            value = body[at].value
            if value is not None and value != Name(name):
                return self._ways(value, steps + 1)
        return ()

    def _called(self, callee: Expr, steps: int) -> Sequence[str]:
        if isinstance(callee, Member):
            ways = self._ways(callee.base, steps + 1)
            return ways if callee.name in _SELF else tuple(f"{way}.{callee.name}()" for way in ways)
        name = self._inherited(callee)
        if name:
            return tuple(f"{base}.{name}()" for base in self._bases)
        written = callee.id.removeprefix("::") if isinstance(callee, Name) else ""
        is_foreign = "::" in written and written.partition("::")[0] not in _OWN
        return (f"{written}()",) if is_foreign else ()


def foreign_bases(cls: Cls | None, objects: Objects) -> Sequence[str]:
    """Return the base classes of a class that other packages have, qualified where the tree shows them."""
    if cls is None:
        return ()
    found: dict[str, None] = {}
    for name in objects.program.base_names(cls):
        base = objects.program.class_named(name, cls.file, cls.qualified)
        if base is None or base.file.package != cls.file.package:
            found[base.qualified if base is not None else name] = None
    return [name for name in found if name.partition("::")[0] not in _OWN]
