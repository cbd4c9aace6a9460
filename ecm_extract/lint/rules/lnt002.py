"""LNT002: a robot description calls a macro that does not exist, or includes a file that is not there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT002",
    name="description_broken",
    dimension="resources",
    severity="error",
    who="config",
    consequence="xacro stops with an error and the robot has no description",
    resolution="define it, include the file that does, or correct the name",
)
_BROKEN = re.compile(r"macro `(?P<macro>[^`]+)` is not defined|included file `(?P<file>[^`{]+)` is not in the tree")
_OPEN = frozenset("{}[]<>$")
"""In a name that only the launch knows, or of a template that somebody fills in."""
_MISSING = re.compile(r"`(?P<name>[^`]+)` is not given to macro `(?P<macro>[^`]+)`")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report what xacro cannot expand, in descriptions whose files are all in the tree."""
    for description in workspace.descriptions:
        outside = any("is known at launch only" in message for _, _, message in description.problems)
        for path, line, message in description.problems:
            match = _BROKEN.search(message)
            if outside and match is not None and match["macro"]:
                continue  # the file that defines the macro may be the one that is outside
            match = match or _MISSING.search(message)
            if match is None:
                continue
            name = next(part for part in match.groups() if part)
            if _OPEN & set(name):
                continue
            package = workspace.package_of(path)
            text = f"{message} (expanding {description.path})"
            yield RULE.finding(text, Entity("macro", name), package, [Evidence(path, line)])
