"""LNT002: a robot description calls a macro that does not exist, or includes a file that is not there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.description.model import Description
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
_MACRO = re.compile(r"macro `([^`]+)` is not defined")
_FILE = re.compile(r"included file `([^`{]+)`(, which an argument chooses,)? is not in the tree")
_LEFT_OUT = re.compile(r"`([^`]+)`.* not given to macro `[^`]+`")
_ELSEWHERE = ("is known at launch only", "which an argument chooses")
_OPEN = frozenset("{}[]<>$")
"""In a name that only the launch knows, or of a template that somebody fills in."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report what xacro cannot expand, in descriptions whose files are all in the tree."""
    parts = {path for each in workspace.descriptions for path in each.files if path != each.path}
    for description in workspace.descriptions:
        whole = _defines_all(description) and description.path not in parts
        for path, line, message in description.problems:
            match = _FILE.search(message) or _LEFT_OUT.search(message)
            if match is None and whole:
                match = _MACRO.search(message)
            if match is None or _OPEN & set(match[1]):
                continue
            if match.re is _FILE and _is_elsewhere(match[1], path, workspace):
                continue
            text = f"{message} (expanding {description.path})"
            evidence = [Evidence(path, line)]
            chosen = match.re is _FILE and match[2] is not None
            yield RULE.finding(
                text,
                Entity("macro", match[1]),
                workspace.package_of(path),
                evidence,
                certainty="likely" if chosen else "proved",
            )


def _is_elsewhere(name: str, path: str, workspace: Workspace) -> bool:
    """Tell whether an included file may exist all the same: on the machine, or made by the build."""
    places = (name,) if name.startswith("/") else (f"{TREE}{name}", f"{workspace.files.folder(path)}/{name}")
    return any(workspace.files.is_elsewhere(place) for place in places)


def _defines_all(description: Description) -> bool:
    """Tell whether every macro must be defined here: a robot without a name is a part that another file includes."""
    messages = [message for _, _, message in description.problems]
    outside = any(each in message for message in messages for each in _ELSEWHERE)
    on_machine = any((match := _FILE.search(message)) and match[1].startswith(("/", "~")) for message in messages)
    return bool(description.name) and not outside and not on_machine
