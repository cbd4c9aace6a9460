"""LNT028: the result of a conversion between frames is computed and never used."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.source.expr import Name

from ecm_extract.link.code.units import Func
from ecm_extract.lint.frame_values import Conversions
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.source_text import names_in
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


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report C++ variables that a conversion gives and that nothing behind in the function names."""
    for functions in workspace.linker.program.functions.values():
        for func in functions:
            if func.file.language == "cpp" and func.file.package in workspace.by_name:
                yield from _of(func, workspace)


def _of(func: Func, workspace: Workspace) -> Iterator[Finding]:
    conversions = Conversions(func, workspace.linker.folder.objects)
    for at, statement in enumerate(func.fact.body):
        if statement.kind != "let" or not isinstance(statement.target, Name) or not conversions.declares(at):
            continue
        name = statement.target.id
        if not _is_named_again(name, statement.line, func, workspace):
            text = f"{name} is converted and never used"
            entity = Entity("function", f"{func.fact.scope}::{func.fact.name}", name)
            evidence = [Evidence(func.file.path, statement.line)]
            yield RULE.finding(text, entity, func.file.package, evidence, certainty="likely")


def _is_named_again(name: str, line: int, func: Func, workspace: Workspace) -> bool:
    """Tell whether the code from a line to the end of a function has a name twice: facts do not hold every use."""
    code = b"\n".join(workspace.files.lines(func.file.path)[line - 1 : func.fact.end_line])
    return sum(each.value == name for each in names_in(code, func.file.language)) > 1
