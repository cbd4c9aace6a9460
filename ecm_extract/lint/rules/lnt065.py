"""LNT065: a launch file in Python tests a launch argument as an object, or its text as a truth value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.launch.doubts import OBJECT_TESTED
from ecm_parsers.launch.model import Argument
from ecm_parsers.launch.templates import all_actions, plain_text

from ecm_extract.entities.launch_values import is_judged
from ecm_extract.lint.launch_problems import told
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT065",
    name="launch_object_tested",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="the same side is taken whatever the argument is",
    resolution="compare the text that perform(context) gives with a text, in an OpaqueFunction; or use a condition",
    tier="stable",
)


_WORDS: Final = frozenset({"true", "false"})


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each test that comes out the same whatever the launch is given."""
    yield from told(RULE, OBJECT_TESTED, workspace)
    switches = _switches(workspace)
    for package in workspace.packages:
        for entry in package.root.files:
            file = workspace.launches.get(entry.path)
            for each in file.texts_tested if file is not None and is_judged(entry.path) else ():
                if switches.get((entry.path, each.name), switches.get(("", each.name))):
                    wrong = f"the text of `{each.name}` is tested, and `false` holds as well as `true`"
                    yield RULE.finding(
                        f"{entry.path}: {wrong}",
                        Entity("launch_file", workspace.in_package(entry.path), wrong),
                        package.name,
                        [Evidence(entry.path, each.line)],
                        certainty="proved" if (entry.path, each.name) in switches else "likely",
                    )


def _switches(workspace: Workspace) -> Mapping[tuple[str, str], bool]:
    """Whether each file, and below no path all of them, declares an argument as one of true and false."""
    found: dict[tuple[str, str], bool] = {}
    for path, file in workspace.launches.items():
        for action in all_actions(file.actions):
            if isinstance(action, Argument):
                for key in ((path, action.name), ("", action.name)):
                    found[key] = found.get(key, True) and _is_switch(action)
    return found


def _is_switch(argument: Argument) -> bool:
    default = plain_text(argument.default)
    return default is not None and {default.strip().lower(), *(each.lower() for each in argument.choices)} <= _WORDS
