"""Findings of what the reader of launch files says of them."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.entities.launch_values import is_judged
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace


def told(rule: LintRule, code: str, workspace: Workspace, severity: Severity | None = None) -> Iterator[Finding]:
    """Yield a finding for each problem of a code, in the launch files of the packages that run as they are."""
    for package in workspace.packages:
        for entry in package.root.files:
            for problem in workspace.launch_problems.get(entry.path, ()) if is_judged(entry.path) else ():
                if problem.code == code:
                    lines = [Evidence(entry.path, problem.line)]
                    entity = Entity("launch_file", workspace.in_package(entry.path), problem.wrong)
                    text = f"{entry.path}: {problem.wrong}"
                    yield rule.finding(text, entity, package.name, lines, severity=severity)
