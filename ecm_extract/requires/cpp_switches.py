"""C++: hardware components that answer a mode switch by the types of interfaces, whichever joint they are of.

Source: control.ros.org, "Writing a Hardware Component".
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Final

from ecm_checker.hub.requirement import Requirement
from ecm_parsers.source.expr import Call, Expr, Member, Name, Text

from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.index.program import Program
from ecm_extract.requires.place import Place, required

SWITCH: Final = "prepare_command_mode_switch"
ANY_JOINT: Final = "*"
_OWN: Final = re.compile(r"^info_$|joint|gpio|sensor|export|prefix|^names?_?$", re.IGNORECASE)
"""Identifiers by which a component knows what is its own."""


def switch_requirements(program: Program) -> Iterator[tuple[str, Requirement]]:
    """Yield the package and the requirement of each component that takes part in switches of any joint."""
    for func in switches_by_type(program):
        place = Place(func.file.path, func.fact.line, f"class {func.fact.scope}")
        yield func.file.package, required("answers_switch", ANY_JOINT, place, "likely", scope=func.fact.scope)


def switches_by_type(program: Program) -> Iterator[Func]:
    """Yield mode switches that take names apart at the slash and never look at the component's own names."""
    for func in program.functions.get(SWITCH, ()):
        if func.fact.body and func.file.language == "cpp":
            bodies = [func, *_lambdas(program, func)]
            if _by_type_only(bodies) and not _hands_on(bodies):
                yield func


def _lambdas(program: Program, func: Func) -> Sequence[Func]:
    """Named lambdas inside a function."""
    scope = f"{func.fact.scope}::{func.fact.name}".removeprefix("::")
    own = program.functions_in(func.file)
    return [entry for entry in own if "lambda" in entry.fact.traits and entry.fact.scope.endswith(scope)]


def _by_type_only(bodies: Sequence[Func]) -> bool:
    found = list(_expressions(bodies))
    is_split = any(isinstance(expr, Text) and expr.value == "/" for expr in found)
    return is_split and not any(map(_OWN.search, map(_identifier, found)))


def _identifier(expr: Expr) -> str:
    """The name of a variable, function or member without what qualifies it; empty for anything else."""
    if isinstance(expr, Name):
        return expr.id.rpartition("::")[2]
    return expr.name if isinstance(expr, Member) else ""


def _hands_on(bodies: Sequence[Func]) -> bool:
    """Whether the lists go on to another function, which may look at what this one does not."""
    given = {parameter.name for parameter in bodies[0].fact.params}
    calls = (expr for expr in _expressions(bodies) if isinstance(expr, Call) and _identifier(expr.callee))
    return any(isinstance(arg, Name) and arg.id in given for call in calls for arg in call.args)


def _expressions(bodies: Sequence[Func]) -> Iterator[Expr]:
    for body in bodies:
        for statement in body.fact.body:
            for expr, _ in expressions(statement):
                yield expr
