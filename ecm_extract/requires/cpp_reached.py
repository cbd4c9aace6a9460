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

from ecm_extract.link.code.containers import ELEMENT_METHODS
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Func
from ecm_extract.requires.cpp_body import Body
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


def reached_requirements(body: Body) -> Iterator[Requirement]:
    """Yield the requirements of a body; of one member that it touches alike in several lines, one."""
    ways, lines = _Ways(body), dict[_Touched, dict[int, None]]()
    for statement in body.statements:
        for touched, line in _touched(statement, ways):
            lines.setdefault(touched, {})[line] = None
    func = body.func
    scope = func.cls.qualified if func.cls is not None else func.fact.scope
    for touched, at in lines.items():
        yield _required(touched, func, scope, tuple(at))


def _touched(statement: Sequence[tuple[Expr, int]], ways: _Ways) -> Iterator[tuple[_Touched, int]]:
    around: Expr | None = None  # an expression is followed by what it calls, or whose member it is
    for expr, line in statement:
        is_inside = isinstance(around, Member) and expr is around.base
        if isinstance(expr, Call):
            for owner, name in ways.touched(expr.callee):
                yield _Touched(owner, name, len(expr.args), is_inside), line
        elif not isinstance(around, Call) or expr is not around.callee:
            for owner, name in ways.touched(expr):
                yield _Touched(owner, name, inside=is_inside), line
        around = expr


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

    def __init__(self, body: Body) -> None:
        self._func, self._objects, self._classes = body.func, body.objects, body.classes
        self._of_class, self._bases = body.inherited, body.inherited.bases
        self._given = {parameter.name for parameter in body.func.fact.params}

    def touched(self, expr: Expr) -> Sequence[tuple[str, str]]:
        """Return the ways to what an expression that is no local touches of another package, and the name of it."""
        name = self._inherited(expr) if self._bases else ""
        if name:
            return [(base, name) for base in self._bases]
        if isinstance(expr, Member) and not self._classes.of(expr.base):
            return [(way, expr.name) for way in self._ways(expr.base)]
        return ()

    def _inherited(self, expr: Expr) -> str:
        """The name of a member that only a base class of another package can have; empty for any other."""
        if is_own_member(expr):
            return "" if self._of_class.is_own(expr.name) else expr.name
        if not isinstance(expr, Name) or "::" in expr.id or _MACRO.fullmatch(expr.id) or expr.id == "this":
            return ""
        local = expr.id in self._given or expr.id in self._objects.scope.locals_of(self._func)
        return "" if local or self._of_class.is_own(expr.id) else expr.id

    def _ways(self, expr: Expr, steps: int = 0) -> Sequence[str]:
        """The ways to an object; none where it is no other package's."""
        if steps > MAX_STEPS:
            return ()
        known = self._classes.declared(expr) if not isinstance(expr, Call) else ""
        if known:
            return (known,)
        name = self._inherited(expr) if self._bases else ""
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
        name = self._inherited(callee) if self._bases else ""
        if name:
            return tuple(f"{base}.{name}()" for base in self._bases)
        written = callee.id.removeprefix("::") if isinstance(callee, Name) else ""
        is_foreign = "::" in written and written.partition("::")[0] not in _OWN
        return (f"{written}()",) if is_foreign else ()
