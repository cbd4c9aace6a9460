"""LNT002: a robot description calls a macro that does not exist, or includes a file that is not there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.description.model import Description, Problem
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.system.files import TREE

RULE = LintRule(
    id="LNT002",
    name="description_broken",
    dimension="resources",
    severity="error",
    who="config",
    consequence="xacro stops with an error and the robot has no description",
    resolution="define it, include the file that does, or correct the name",
)
_FILES: Final = frozenset({"file", "chosen_file"})
_ELSEWHERE: Final = frozenset({"late", "chosen_file", "unread"})
_OPEN = frozenset("{}[]<>$")
"""In a name that only the launch knows, or of a template that somebody fills in."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report what xacro cannot expand, in descriptions whose files are all in the tree or kept by documents beside it.

    Not asked of the engine: which macro a call means, and what it is given, is told by running the description in
    order, with files that properties and arguments name; documents keep the descriptions, and these are run.
    """
    parts = {path for each in workspace.descriptions for path in each.files if path != each.path}
    for description in workspace.descriptions:
        whole = _defines_all(description) and description.path not in parts
        for problem in description.problems:
            if _is_told(problem, workspace, whole=whole):
                yield RULE.finding(
                    f"{problem.message} (expanding {description.path})",
                    Entity("macro", problem.about),
                    workspace.package_of(problem.path),
                    [Evidence(problem.path, problem.line)],
                    certainty="likely" if problem.kind == "chosen_file" else "proved",
                )


def _is_told(problem: Problem, workspace: Workspace, *, whole: bool) -> bool:
    """Tell whether xacro stops at a problem; a macro may be defined by who includes a part of a robot."""
    if not problem.about or _OPEN & set(problem.about):
        return False
    if problem.kind in _FILES:
        return not _is_elsewhere(problem.about, problem.path, workspace)
    return problem.kind == "argument" or (problem.kind == "macro" and whole)


def _is_elsewhere(name: str, path: str, workspace: Workspace) -> bool:
    """Tell whether an included file may exist all the same: on the machine, or made by the build."""
    files = workspace.beside.files
    places = (name,) if name.startswith("/") else (f"{TREE}{name}", f"{files.folder(path)}/{name}")
    return any(files.is_elsewhere(place) for place in places)


def _defines_all(description: Description) -> bool:
    """Tell whether every macro must be defined here: a robot without a name is a part that another file includes."""
    outside = any(each.kind in _ELSEWHERE for each in description.problems)
    on_machine = any(each.kind in _FILES and each.about.startswith(("/", "~")) for each in description.problems)
    return bool(description.name) and not outside and not on_machine
