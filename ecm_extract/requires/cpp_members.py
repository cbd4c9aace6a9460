"""C++: methods called on, and members read of, objects whose class another package provides.

The class of an object is told by its declaration: a parameter, a local, a member of the own class, the class itself
and what it derives from. What is not declared in the tree (`auto` of a foreign call) has no class here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.handles import verbs
from ecm_checker.hub.requirement import Given, Requirement
from ecm_parsers.source.expr import THIS, Call, Expr, Member

from ecm_extract.link.code.units import Func
from ecm_extract.requires.cpp_body import Body
from ecm_extract.requires.foreign_classes import ForeignClasses
from ecm_extract.requires.place import Place, required


class _Touched(msgspec.Struct, frozen=True):
    """A member of an object of a class, and with how many arguments it is called; -1 where it is read."""

    owner: str
    name: str
    count: int = -1


def member_requirements(body: Body) -> Iterator[Requirement]:
    """Yield the requirements of a body; of one member that it touches alike in several lines, one."""
    lines: dict[_Touched, dict[int, None]] = {}
    for statement in body.statements:
        for touched, line in _touched(statement, body.classes):
            lines.setdefault(touched, {})[line] = None
    for touched, found in lines.items():
        yield _required(touched, body.func, tuple(found))
    yield from _handled(body)


def _handled(body: Body) -> Iterator[Requirement]:
    """Yield what takes or gives back something, of whichever class: who gives back may hold it in a type not told."""
    path = body.func.file.path
    lines: dict[str, int] = {}
    for statement in body.statements:
        for expr, line in statement:
            if isinstance(expr, Call) and isinstance(expr.callee, Member):
                member = expr.callee
                if member.name.startswith(verbs()) and member.base != THIS:
                    lines.setdefault(member.name, line)
    for name, line in lines.items():
        yield required("handles", name, Place(path, line, f"file {path}"), "unknown")


def _touched(statement: Sequence[tuple[Expr, int]], classes: ForeignClasses) -> Iterator[tuple[_Touched, int]]:
    callee: Member | None = None  # a call is followed by what it calls
    for expr, line in statement:
        if isinstance(expr, Call):
            callee = expr.callee if isinstance(expr.callee, Member) else None
            member, count = callee, len(expr.args)
        else:
            member, count = (expr if isinstance(expr, Member) and expr is not callee else None), -1
        if member is None:
            continue
        owner = classes.of(member.base)
        if owner:
            yield _Touched(owner, member.name, count), line


def _required(touched: _Touched, func: Func, lines: tuple[int, ...]) -> Requirement:
    place = Place(func.file.path, lines[0], f"file {func.file.path}")
    use = "reads_member" if touched.count < 0 else "calls_method"
    given = None if touched.count < 0 else Given(count=touched.count)
    evidence = tuple(Evidence(func.file.path, line) for line in lines)
    scope = _scope(func)
    return required(use, touched.name, place, owner=touched.owner, scope=scope, given=given, evidence=evidence)


def _scope(func: Func) -> str:
    """Where the class is looked for: `client::Reader` inside of `arm` may be `arm::client::Reader`."""
    return f"{func.fact.scope}::{func.fact.name}" if func.fact.scope else ""
