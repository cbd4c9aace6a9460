"""C++: results that a body takes twice, as only a shared future allows.

Source: `std::future::get` leaves the future without a state; of a `std::shared_future` it may be called again.
"""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.requirement import Requirement
from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.index.program import Program
from ecm_extract.requires.place import Place, required


def result_requirements(program: Program) -> Iterator[tuple[str, Requirement]]:
    """Yield package and requirement of each result of a method whose `get()` a body calls more than once."""
    for functions in program.functions.values():
        for func in functions:
            if func.file.language == "cpp":
                for found in _of(func):
                    yield func.file.package, found


def _of(func: Func) -> Iterator[Requirement]:
    held = dict(_held(func))
    taken: dict[str, list[int]] = {}
    for statement in func.fact.body if held else ():
        for expr, line in expressions(statement):
            name = _got(expr)
            if name in held:
                taken.setdefault(name, []).append(line)
    for name, lines in taken.items():
        if len(lines) > 1:
            place = Place(func.file.path, lines[1], f"file {func.file.path}")
            yield required("takes_again", held[name], place, "likely", said=name)


def _held(func: Func) -> Iterator[tuple[str, str]]:
    """Variables that hold the result of a method, and its name."""
    for statement in func.fact.body:
        target, value = statement.target, statement.value
        if statement.kind == "let" and isinstance(target, Name) and isinstance(value, Call):
            callee = value.callee
            if isinstance(callee, Member) and len(value.args) == 1:
                yield target.id, callee.name


def _got(expr: Expr) -> str:
    """The variable of `variable.get()`; empty for anything else."""
    callee = expr.callee if isinstance(expr, Call) else None
    base = callee.base if isinstance(callee, Member) and callee.name == "get" else None
    return base.id if isinstance(base, Name) else ""
