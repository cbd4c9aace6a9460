"""LNT028: the result of a conversion between frames is computed and never used."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.units import Func
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT028",
    name="conversion_dropped",
    dimension="signature",
    severity="warning",
    who="safety",
    consequence="the data goes on in the frame that it came in, and the robot turns or moves the wrong way",
    resolution="use the converted value, or do not compute it",
)
_CONVERSION = re.compile(
    r"(?:^|_)transform(?:_|$)|_to_(?:enu|ned|rpy|baselink|aircraft|world)|ned_enu|frame_conversion|toEuler"
)
_KEPT = re.compile(r"listener|broadcaster|buffer|guard|lock")
"""Objects that work by being there."""
MAX_DEPTH = 40


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report C++ variables that a conversion gives and that no later statement of the function mentions."""
    for functions in workspace.linker.program.functions.values():
        for func in functions:
            if func.file.language == "cpp" and func.file.package in workspace.by_name:
                yield from _of(func, workspace)


def _of(func: Func, workspace: Workspace) -> Iterator[Finding]:
    for at, statement in enumerate(func.fact.body):
        if statement.kind != "let" or not isinstance(statement.target, Name) or not _converts(statement.value):
            continue
        name = statement.target.id
        rest = func.fact.body[:at] + func.fact.body[at + 1 :]
        if statement.type.endswith("&") or _KEPT.search(name) or any(_mentions(other, name) for other in rest):
            continue
        if _is_written_again(name, statement.line, func, workspace):
            continue
        text = f"{name} is converted and never used"
        entity = Entity("function", f"{func.fact.scope}::{func.fact.name}", name)
        evidence = [Evidence(func.file.path, statement.line)]
        yield RULE.finding(text, entity, func.file.package, evidence, certainty="likely")


def _is_written_again(name: str, line: int, func: Func, workspace: Workspace) -> bool:
    """Tell whether the text of the function has the name a second time: not every expression is read."""
    lines = (workspace.files.read(func.file.path) or b"").splitlines()[line - 1 : func.fact.end_line]
    return len(re.findall(rb"\b%s\b" % re.escape(name.encode()), b"\n".join(lines))) > 1


def _converts(value: Expr | None) -> bool:
    if not isinstance(value, Call):
        return False
    callee = value.callee
    name = (
        callee.name if isinstance(callee, Member) else callee.id.rsplit("::", 1)[-1] if isinstance(callee, Name) else ""
    )
    return _CONVERSION.search(name) is not None and bool(value.args)


def _mentions(statement: Statement, name: str) -> bool:
    return _holds(statement.value, name) or _holds(statement.target, name)


def _holds(expr: object, name: str, depth: int = 0) -> bool:
    if isinstance(expr, Name):
        return expr.id == name
    if isinstance(expr, tuple):
        return any(_holds(item, name, depth + 1) for item in expr)
    if depth > MAX_DEPTH or not hasattr(expr, "__struct_fields__"):
        return isinstance(expr, str) and name in expr
    return any(_holds(getattr(expr, field), name, depth + 1) for field in expr.__struct_fields__)
