"""LNT047: a hardware component answers a mode switch for interfaces that are not its own.

Source: control.ros.org, "Writing a Hardware Component"; until ros2_control 4.31 and 5.1 every component is handed the
interfaces of all components.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.source.expr import Call, Member, Name

from ecm_extract.link.program import Program
from ecm_extract.link.units import Func
from ecm_extract.link.walk import calls_in
from ecm_extract.lint.expressions import identifiers, texts
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT047",
    name="mode_switch_of_others",
    dimension="resources",
    severity="warning",
    who="safety",
    consequence="with two robots in one controller manager, a switch of the one stops or refuses the other",
    resolution="compare the whole name `joint/interface` with the interfaces that the component exports",
)
_METHOD: Final = "prepare_command_mode_switch"
_SCOPED: Final = (">=4.31,<5", ">=5.1")
"""Versions whose resource manager hands each component its own interfaces only (ros2_control changelog)."""
_OWN: Final = re.compile(r"^info_$|joint|gpio|sensor|export|prefix|^names?_?$", re.IGNORECASE)
"""Identifiers by which a component knows what is its own."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report mode switches that take names apart at the slash and never look at the component's own names."""
    if any(workspace.provides("hardware_interface", versions) for versions in _SCOPED):
        return
    program = workspace.linker.program
    for func in program.functions.get(_METHOD, ()):
        if func.fact.body and func.file.language == "cpp" and func.file.package in workspace.by_name:
            bodies = [func, *_lambdas(program, func)]
            if _by_type_only(bodies) and not _hands_on(bodies):
                owner = func.fact.scope
                text = f"{owner}::{_METHOD} looks at the types of the interfaces alone"
                evidence = [Evidence(func.file.path, func.fact.line)]
                entity = Entity("method", f"{owner}::{_METHOD}")
                yield RULE.finding(text, entity, func.file.package, evidence, certainty="likely")


def _lambdas(program: Program, func: Func) -> Sequence[Func]:
    """Named lambdas inside a function."""
    scope = f"{func.fact.scope}::{func.fact.name}".removeprefix("::")
    own = program.functions_in(func.file)
    return [entry for entry in own if "lambda" in entry.fact.traits and entry.fact.scope.endswith(scope)]


def _by_type_only(bodies: Sequence[Func]) -> bool:
    names = {name for body in bodies for statement in body.fact.body for name in identifiers(statement)}
    if "/" not in {text for body in bodies for statement in body.fact.body for text in texts(statement)}:
        return False
    return not any(_OWN.search(name) for name in names)


def _hands_on(bodies: Sequence[Func]) -> bool:
    """Whether the lists go on to another function, which may look at what this one does not."""
    given = {parameter.name for parameter in bodies[0].fact.params}
    for body in bodies:
        for statement in body.fact.body:
            for call in (*calls_in(statement.value), *calls_in(statement.target)):
                if _callee(call) and any(isinstance(arg, Name) and arg.id in given for arg in call.args):
                    return True
    return False


def _callee(call: Call) -> bool:
    return isinstance(call.callee, Name | Member)
