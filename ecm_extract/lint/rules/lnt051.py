"""LNT051: Python unpacks another number of values than a function returns or a member holds."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.tuples import Count, Taken, count_of, held, returned, taken_by
from ecm_extract.link.code.units import Func
from ecm_extract.lint.python_calls import callees
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT051",
    name="values_unpacked_otherwise",
    dimension="signature",
    severity="error",
    who="source",
    consequence="Python stops with ValueError when it gets there",
    resolution="unpack as many values as there are",
)
_GENERATOR: Final = "generator"
"""A trait of functions whose calls give what they yield, not what they return."""


class _Unpacking(NamedTuple):
    """Values taken apart: the variables for them, and where they come from."""

    line: int
    target: Expr
    source: Call | Taken


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report assignments and loops that unpack what the same tree makes with another number of values."""
    for functions in workspace.linker.program.functions.values():
        for func in functions:
            if func.file.language == "python" and func.file.package in workspace.by_name:
                yield from _of(func, workspace)


def _of(func: Func, workspace: Workspace) -> Iterator[Finding]:
    told = set()
    for found in _unpackings(func):
        wanted = count_of(found.target)
        made = _made(found.source, func, workspace) if wanted is not None else None
        what = _name(found.source)
        if made is None or made.values == wanted or what in told or _is_starred(found.target):
            continue
        told.add(what)
        text = f"{wanted} values are unpacked here, and {what} {made.values}"
        evidence = [Evidence(func.file.path, found.line), Evidence(made.path, made.line)]
        entity = Entity("function", f"{func.fact.scope}::{func.fact.name}", what)
        own = isinstance(found.source, Taken) or getattr(found.source.callee, "base", None) == THIS
        certainty: Certainty = "likely" if own else "proved"
        yield RULE.finding(text, entity, func.file.package, evidence, certainty=certainty)


def _unpackings(func: Func) -> Iterator[_Unpacking]:
    for statement in func.fact.body:
        target, value = statement.target, statement.value
        if not isinstance(target, Items):
            continue
        taken = taken_by(value)
        if statement.kind == "each" and taken is not None and taken.how == "items":
            yield _Unpacking(statement.line, target.items[-1], taken)
        elif taken is not None and (statement.kind == "each") == (taken.how in {"each", "values"}):
            yield _Unpacking(statement.line, target, taken)
        elif isinstance(value, Call) and statement.kind == "set":
            yield _Unpacking(statement.line, target, value)
        elif isinstance(value, Name) and statement.kind == "set":
            origin = _only_origin(value, func)
            yield from [_Unpacking(statement.line, target, origin)] if origin is not None else []


def _only_origin(name: Name, func: Func) -> Taken | None:
    """The member whose elements a variable holds, if it never holds anything else."""
    found = {_origin(statement, name) for statement in func.fact.body if name in _variables(statement.target)}
    return found.pop() if len(found) == 1 else None


def _origin(statement: Statement, name: Name) -> Taken | None:
    taken = taken_by(statement.value)
    if taken is None or (statement.kind == "each") != (taken.how != "key"):
        return None
    if taken.how == "items":
        return taken if isinstance(statement.target, Items) and statement.target.items[-1] == name else None
    return taken if statement.target == name else None


def _variables(target: Expr | None) -> tuple[Expr, ...]:
    return target.items if isinstance(target, Items) else (target,) if target is not None else ()


def _made(source: Call | Taken, func: Func, workspace: Workspace) -> Count | None:
    program = workspace.linker.program
    if isinstance(source, Taken):
        return held(source, program.ancestry(func.cls)) if func.cls is not None else None
    reached = callees(source, func, program)
    counts = [returned(other) if _GENERATOR not in other.fact.traits else None for other in reached]
    same = {count.values if count is not None else None for count in counts}
    return counts[0] if len(same) == 1 else None


def _is_starred(target: Expr) -> bool:
    """Tell whether a star takes what is left over."""
    return any(unstarred(item) is not item for item in _variables(target))


def _name(source: Call | Taken) -> str:
    if isinstance(source, Taken):
        return f"every element of self.{source.member} has"
    callee = source.callee
    return f"{callee.name if isinstance(callee, Member) else dotted_name(callee)}() returns"
