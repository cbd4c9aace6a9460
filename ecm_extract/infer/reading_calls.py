"""Calls of the standard library that leave their arguments as they are: in Python by what they are called on, too."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Final, TypeAlias

from ecm_parsers.source.expr import THIS, Call, Comprehension, Expr, Items, Member, Name, Op, Table, Template, Text

from ecm_extract.infer.library_calls import calls_of
from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.walk import dotted, last_of

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func

_Says: TypeAlias = "Callable[[Expr, Func, int], bool]"
_DISPLAYS: Final = (Text, Template, Items, Table, Comprehension)
_MAX_STEPS: Final = 8
"""Variables, sums and methods that are looked through."""


def leaves_arguments(callee: Expr, func: Func) -> bool:
    """Tell whether a function of a library that a call in a function names leaves what it gets as it is."""
    calls = calls_of(func.file.language)
    if func.file.language != "python":
        return last_of(callee) in calls.reading
    imported = func.file.imported
    if full_name(dotted(callee) or "", imported) in calls.reading_paths:
        return True
    if not isinstance(callee, Member):
        return isinstance(callee, Name) and callee.id in calls.reading and callee.id not in imported
    if callee.name in calls.reading_methods:
        return _is_one(callee.base, func, _is_built_in)
    return callee.name in calls.logging_methods and _is_one(callee.base, func, _is_logger)


def _is_one(expr: Expr, func: Func, says: _Says, steps: int = 0) -> bool:
    """Whether an expression is an object of a kind: it says so itself, or all that a variable is given does."""
    if steps > _MAX_STEPS:
        return False
    given = list(_given(expr, func))
    return says(expr, func, steps) or (bool(given) and all(_is_one(each, func, says, steps + 1) for each in given))


def _is_built_in(expr: Expr, func: Func, steps: int) -> bool:
    """Whether an expression is of a built-in type, by its form: `[a]`, `"x" + a`, `str(a).strip()`."""
    if isinstance(expr, Op):
        return expr.op in {"%", "+"} and _is_one(expr.operands[0], func, _is_built_in, steps + 1)
    if not isinstance(expr, Call):
        return isinstance(expr, _DISPLAYS)
    calls, written = calls_of("python"), dotted(expr.callee) or ""
    if (full_name(written, func.file.imported) or written) in calls.built_in:
        return True
    callee = expr.callee
    of_one = isinstance(callee, Member) and callee.name in calls.reading_methods
    return of_one and isinstance(callee, Member) and _is_one(callee.base, func, _is_built_in, steps + 1)


def _is_logger(expr: Expr, _func: Func, _steps: int) -> bool:
    return isinstance(expr, Call) and last_of(expr.callee) in calls_of("python").loggers


def _given(expr: Expr, func: Func) -> Iterator[Expr]:
    """What a variable of a function, of its object or of its module is given; a parameter is what its type says."""
    if isinstance(expr, Name):
        parameter = next((each for each in func.fact.params if each.name == expr.id), None)
        if parameter is not None:
            yield Call(Name(parameter.type.partition("[")[0]), ()) if parameter.type else expr
        yield from _values(expr, func)
        constants = (each for each in func.file.facts.constants if each.name == expr.id)
        yield from (expr if each.value is None else each.value for each in constants)
    elif isinstance(expr, Member) and expr.base == THIS and func.cls is not None:
        for method in func.cls.methods:
            yield from _values(expr, method)


def _values(target: Expr, func: Func) -> Iterator[Expr]:
    """What the statements of a function give a variable; one that binds it otherwise gives what nothing tells."""
    for entry in func.fact.body:
        if entry.target == target and entry.kind != "do":
            told = entry.kind in {"let", "set"} and not entry.type.endswith("=")
            yield entry.value if told and entry.value is not None else target
