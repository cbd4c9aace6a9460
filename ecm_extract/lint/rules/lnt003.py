"""LNT003: a launch file starts a program that its package does not build."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from ecm_checker.finding import Entity, Finding
from ecm_parsers.launch.model import Node

from ecm_extract.lint.cmake_makers import asks, makers
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, all_actions, evidence_of, plain_text
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.model import Place

RULE = LintRule(
    id="LNT003",
    name="executable_missing",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="the node never starts, and the launch goes on without it",
    resolution="correct the name, or install the program",
)
RENAME = re.compile(r"builds no program (?P<old>\S+); it builds (?P<new>[^\s:]+)")

_OUTPUT = re.compile(rb"\bOUTPUT\s+\"?(?:[^\s\"()]*/)?([\w.-]+)")
"""The last part of what a custom command makes."""
_OUTPUT_NAME = re.compile(rb"OUTPUT_NAME\s+\"?([\w.${}-]+)")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report nodes of launch files whose program no build file of their package, being in the tree, makes."""
    commands = makers(workspace)
    open_ended = {package.name for package in workspace.packages if asks(package, commands, workspace)}
    for path, facts in workspace.launches.items():
        for action in all_actions(facts.actions):
            if not isinstance(action, Node) or action.kind == "component":
                continue
            package, name = plain_text(action.package), plain_text(action.executable)
            target = workspace.by_name.get(package or "")
            if not name or target is None or target.name in open_ended or not _is_understood(target):
                continue
            programs = executables(workspace, target)
            files = {entry.path.rsplit("/", 1)[-1] for entry in target.root.files}
            if not (programs | files | _possible(target)) & {name, name.removesuffix(".py"), f"{name}.py"}:
                near = get_close_matches(name, programs, 1)
                hint = f"write {near[0]}" if near else ""
                text = f"{package} builds no program {name}" + (f"; it builds {near[0]}" if near else "")
                entity = Entity("executable", name, near[0] if near else "")
                place = [evidence_of(Place(path, action.line))]
                yield RULE.finding(text, entity, workspace.package_of(path), place, resolution=hint)


def executables(workspace: Workspace, package: PackageFacts) -> set[str]:
    """Return every name under which a program of a package can be started."""
    targets = [target for file in package.cmake.values() for target in file.targets if target.kind == "executable"]
    found = {name for target in targets for name in (target.name, target.output) if name}
    found |= {entry.executable for file in package.cmake.values() for entry in file.components if entry.executable}
    found |= {entry.name for setup in package.setups.values() for entry in setup.entry_points}
    found |= {name for owner, name in workspace.programs if owner == package.name}
    for path in package.cmake:
        data = workspace.files.read(path) or b""
        names = [*_OUTPUT_NAME.findall(data), *_OUTPUT.findall(data)]
        found |= {match.decode().replace("${PROJECT_NAME}", package.name) for match in names}
    return found


def _possible(package: PackageFacts) -> set[str]:
    """Names that a command of another package may make a program of, and targets that are installed as programs."""
    found = {word for file in package.cmake.values() for word in file.foreign}
    installs = [each for file in package.cmake.values() for each in file.installs]
    found |= {item for each in installs if each.kind == "targets" for item in each.items}
    found |= {item.rpartition("/")[2] for each in installs if each.kind == "programs" for item in each.items}
    return found - {target.name for file in package.cmake.values() for target in file.targets}


def _is_understood(package: PackageFacts) -> bool:
    """Tell whether the build files leave no name of a program open."""
    targets = [target for file in package.cmake.values() for target in file.targets]
    return bool(package.cmake or package.setups) and not any(
        "$" in target.name or "{" in target.name for target in targets
    )
