"""LNT054: a simulator plugin looks a sensor up by its short name, among the sensors of all robots of the world."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.source.expr import Call, Name

from ecm_extract.link.code.calls import Invocation, dotted_name, invocations
from ecm_extract.link.code.units import File, Func
from ecm_extract.lint.expressions import identifiers, texts
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT054",
    name="sensor_by_short_name",
    dimension="behavior",
    severity="warning",
    who="source",
    consequence="with a second robot in the world the lookup fails or gives the sensor of the other one",
    resolution='look it up by its scoped name, "world::model::link::sensor"',
)
_LOOKUPS: Final = frozenset({"GetSensor", "get_sensor"})
_SCOPING: Final = frozenset({"GetScopedName", "ScopedName", "GetParentName", "ParentName", "SensorScopedName"})


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report lookups in the registry of a simulator by a name that no step of the function puts a scope before."""
    program = workspace.linker.program
    packages = {file.package for file in program.files if _is_of_simulator(file)} & set(workspace.by_name)
    for functions in program.functions.values() if packages else ():
        for func in functions:
            if func.file.package in packages and func.file.language == "cpp":
                yield from _of(func)


def _of(func: Func) -> Iterator[Finding]:
    for call in invocations(func, _LOOKUPS):
        if not _asks_all(call) or len(call.args) != 1 or _is_scoped(call):
            continue
        what = call.args[0].id if isinstance(call.args[0], Name) else call.last
        text = f"{what} is looked up among the sensors of all robots in the world"
        entity = Entity("sensor", f"{func.fact.scope}::{func.fact.name}", what)
        yield RULE.finding(text, entity, func.file.package, [Evidence(func.file.path, call.line)], certainty="likely")


def _is_of_simulator(file: File) -> bool:
    return file.language == "cpp" and any(entry.module.startswith("gazebo") for entry in file.facts.imports)


def _asks_all(call: Invocation) -> bool:
    """Whether the sensors of the whole world are meant: `SensorManager::Instance()->GetSensor` or its short form."""
    asked = call.receiver.callee if isinstance(call.receiver, Call) else None
    return "SensorManager" in dotted_name(asked) if asked is not None else call.path.endswith("sensors::get_sensor")


def _is_scoped(call: Invocation) -> bool:
    """Whether the name, or what is assigned to the variable that holds it, has a scope."""
    held = [entry for entry in call.func.fact.body if entry.target == call.args[0] and entry.value is not None]
    steps = [call.statement, *held]
    named = any(name in _SCOPING for step in steps for name in identifiers(step))
    return named or any("::" in text for step in steps for text in texts(step))
