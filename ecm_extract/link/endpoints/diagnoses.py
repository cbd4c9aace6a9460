"""Failures that code reports on /diagnostics: a level and what it says.

Source: diagnostic_msgs/DiagnosticStatus; the API of diagnostic_updater (`summary`, `mergeSummary`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Final, NamedTuple

from ecm_checker.contract import Evidence
from ecm_parsers.source.expr import Expr, Member, Name, Number
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.sites import Sites

SUMMARIES: Final = ("summary", "summaryf", "mergeSummary", "mergeSummaryf")
"""Methods of a status that set its level and its message."""
_LEVELS: Final[Mapping[str, str]] = MappingProxyType({"WARN": "warn", "ERROR": "error", "STALE": "stale"})
_NUMBERS: Final = ("", "warn", "error", "stale")
_NEAR: Final = 3
"""Statements between the level and the message of a status that is filled in by hand."""


class Diagnosis(NamedTuple):
    """One failure: its level in small letters, what it says, the line."""

    level: str
    message: str
    evidence: Evidence


def diagnoses(sites: Sites) -> Iterator[tuple[Cls | Func, Diagnosis]]:
    """Yield the failures that the units of a program report, each with the class or function that does."""
    for name in SUMMARIES:
        for call in sites.calls.get(name, ()):
            if len(call.args) >= 2:
                found = _Told(call.func, call.at, call.args[0], call.args[1], call.line)
                yield from _diagnosis(found, sites)
    for functions in sites.program.functions.values():
        for func in functions:
            for told in _filled_in(func):
                yield from _diagnosis(told, sites)


class _Told(NamedTuple):
    """A level and a message as they are written."""

    func: Func
    at: int
    level: Expr
    message: Expr
    line: int


def _diagnosis(told: _Told, sites: Sites) -> Iterator[tuple[Cls | Func, Diagnosis]]:
    level = _level(told.level)
    if not level:
        return
    for value in sites.folder.fold(told.message, sites.root_env(told.func, told.at)):
        if value.confidence != "pattern" and value.text:
            evidence = Evidence(told.func.file.path, told.line)
            yield told.func.holder or told.func, Diagnosis(level, value.text, evidence)


def _filled_in(func: Func) -> Iterator[_Told]:
    """`status.level = ...` with `status.message = ...` beside it."""
    body = func.fact.body
    for at, statement in enumerate(body):
        if _member_set(statement, "level") and _level(statement.value):
            near = body[max(at - _NEAR, 0) : at + _NEAR + 1]
            same = (other for other in near if _member_set(other, "message") and _base(other) == _base(statement))
            other = next((entry for entry in same if entry.depth == statement.depth), None)
            if other is not None and statement.value is not None and other.value is not None:
                yield _Told(func, at, statement.value, other.value, statement.line)


def _member_set(statement: Statement, name: str) -> bool:
    target = statement.target
    return statement.kind == "set" and isinstance(target, Member) and target.name == name


def _base(statement: Statement) -> Expr | None:
    return statement.target.base if isinstance(statement.target, Member) else None


def _level(expr: Expr | None) -> str:
    """The level of a failure; empty for OK and for what is computed."""
    if isinstance(expr, Number):
        return _NUMBERS[int(expr.value)] if expr.value in range(len(_NUMBERS)) else ""
    name = expr.id if isinstance(expr, Name) else expr.name if isinstance(expr, Member) else ""
    return _LEVELS.get(last_name(name), "")
