"""What may raise: a handler goes on with what variables hold before and after it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Comprehension, Expr, Member, Name, Op, Opaque
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Branch, Loop, Step, Switch

from ecm_extract.infer.kinds import standard_kind
from ecm_extract.infer.library_calls import calls_of
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.walk import children

_OPERATORS: Final = frozenset({"[]", "/", "//", "%"})


def may_raise(expr: Expr | None, language: str) -> bool:
    """Tell whether evaluating an expression may raise: calls, subscripts, divisions, fields that Python looks up."""
    if expr is None:
        return False
    return raises_itself(expr, language) or any(may_raise(part, language) for part in children(expr))


def raises_itself(expr: Expr, language: str) -> bool:
    """Tell whether an expression may raise apart from its parts."""
    if isinstance(expr, Comprehension | Opaque) or (isinstance(expr, Op) and expr.op in _OPERATORS):
        return True
    if isinstance(expr, Call):
        return not _is_calm(expr, language)
    return isinstance(expr, Member) and language == "python" and expr.base != THIS


def _is_calm(call: Call, language: str) -> bool:
    """Whether a call makes a text or an exception, which nothing keeps it from."""
    if not isinstance(call.callee, Name):
        return False
    calm = last_name(call.callee.id) in calls_of(language).calm
    return calm or standard_kind(call.callee.id, language) is not None


def asks_what_raises(step: Step, body: Sequence[Statement], language: str) -> bool:
    """Tell whether a step that chooses or repeats asks for something that may raise."""
    return any(may_raise(expr, language) for expr in _asked(step, body))


def _asked(step: Step, body: Sequence[Statement]) -> Iterator[Expr | None]:
    if isinstance(step, Branch):
        yield step.test
    elif isinstance(step, Loop):
        yield step.test
        yield body[step.each].value if step.each >= 0 else None
    elif isinstance(step, Switch):
        yield step.subject
        yield from (test for case in step.cases for test in case.tests)
