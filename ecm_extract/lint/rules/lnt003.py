"""LNT003: a launch file starts a program that its package does not build."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.launch.model import Node

from ecm_extract.lint.cmake_makers import asks, brings_targets, makers
from ecm_extract.lint.install_rules import install_rules
from ecm_extract.lint.lines import line_of_name
from ecm_extract.lint.near import nearest
from ecm_extract.lint.refused import is_refused
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, all_actions, plain_text
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT003",
    name="executable_missing",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="launch_ros finds no such program and stops the whole launch",
    resolution="correct the name, or install the program",
    tier="stable",
)
RENAME = re.compile(r"builds no program (?P<old>\S+); it builds (?P<new>[^\s:]+)")

_GOES_ON = "roslaunch reports it and goes on without the node"
_OPEN = frozenset("${*?")
"""In a name that CMake computes, such as of each file that a pattern finds."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report nodes of launch files whose program no build file of their package, being in the tree, makes."""
    commands = makers(workspace)
    closed = {
        package.name
        for package in workspace.packages
        if _is_understood(package, workspace) and not asks(package, commands)
    }
    known: dict[str, frozenset[str]] = {}
    for path, facts in workspace.launches.items():
        missing: dict[tuple[str, str], list[Evidence]] = {}
        for action in all_actions(facts.actions):
            if not isinstance(action, Node) or action.kind == "component":
                continue
            package, name = plain_text(action.package), plain_text(action.executable)
            target = workspace.by_name.get(package or "")
            if not name or target is None or target.name not in closed:
                continue
            if target.name not in known:
                known[target.name] = frozenset(_programs(target, workspace))
            if known[target.name].isdisjoint({name, name.removesuffix(".py"), f"{name}.py"}):
                place = Evidence(path, line_of_name(path, action.line, name, workspace))
                missing.setdefault((target.name, name), []).append(place)
        for (owner, name), places in missing.items():
            yield _finding(name, workspace.by_name[owner], places, workspace)


def _finding(name: str, package: PackageFacts, places: list[Evidence], workspace: Workspace) -> Finding:
    """One finding for a launch file that names the program several times."""
    near = nearest(name, _built(package, workspace)) or ""
    text = f"{package.name} builds no program {name}" + (f"; it builds {near}" if near else "")
    return RULE.finding(
        text,
        Entity("executable", name, near),
        workspace.package_of(places[0].path),
        places,
        consequence=_GOES_ON if workspace.files.ros_of(places[0].path) == 1 else "",
        resolution=f"write {near}" if near else "",
    )


def _programs(package: PackageFacts, workspace: Workspace) -> set[str]:
    """Every name that may be a program of a package."""
    return executables(workspace, package) | _files(package) | _possible(package)


def executables(workspace: Workspace, package: PackageFacts) -> set[str]:
    """Return every name under which a program of a package can be started."""
    return _built(package, workspace) | {name for owner, name in workspace.programs if owner == package.name}


def _built(package: PackageFacts, workspace: Workspace) -> set[str]:
    """Names that build files give to programs."""
    targets = [target for file in package.cmake.values() for target in file.targets if target.kind == "executable"]
    found = {name for target in targets for name in (target.name, target.output) if name}
    found |= {entry.executable for file in package.cmake.values() for entry in file.components if entry.executable}
    found |= {entry.name for setup in package.setups.values() for entry in setup.entry_points}
    found |= {rule.renamed for rule in install_rules(package) if rule.kind == "PROGRAMS" and rule.renamed}
    return found | set(_made(package))


def _made(package: PackageFacts) -> Iterator[str]:
    """Names of what custom commands make."""
    for file in package.cmake.values():
        for command in file.commands:
            if command.name == "add_custom_command" and command.args[:1] == ("OUTPUT",):
                outputs = takewhile(lambda word: not word.isupper(), command.args[1:])
                yield from (output.rpartition("/")[2] for output in outputs)


def _files(package: PackageFacts) -> set[str]:
    """Files that are programs: roslaunch looks through the whole package, ROS 2 only where setup.py installs some."""
    is_python = package.ros == 2 and package.setups and not package.cmake
    installed = {name for setup in package.setups.values() for name in setup.scripts}
    installed |= {file for setup in package.setups.values() for data in setup.data_files for file in data.files}
    if is_python and not any("*" in name or "{" in name for name in installed):
        return {name.rpartition("/")[2] for name in installed}
    return {entry.path.rpartition("/")[2] for entry in package.root.files}


def _possible(package: PackageFacts) -> set[str]:
    """Names that a command of another package may make a program of, and targets that are installed as programs."""
    found = {word for file in package.cmake.values() for word in file.foreign}
    installs = [each for file in package.cmake.values() for each in file.installs]
    found |= {item for each in installs if each.kind == "targets" for item in each.items}
    found |= {item.rpartition("/")[2] for each in installs if each.kind == "programs" for item in each.items}
    return found - {target.name for file in package.cmake.values() for target in file.targets}


def _is_understood(package: PackageFacts, workspace: Workspace) -> bool:
    """Tell whether the build files leave no name of a program open."""
    if any(is_refused(path, workspace) for path in package.cmake) or brings_targets(package):
        return False
    targets = [target for file in package.cmake.values() for target in file.targets]
    return bool(package.cmake or package.setups) and not any(_OPEN & set(target.name) for target in targets)
