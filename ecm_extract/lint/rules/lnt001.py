"""LNT001: a launch file includes a file, or names a parameter file, that is not there."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.known import Known
from ecm_extract.lint.named_files import absent_files
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.report.places import in_tree

RULE = LintRule(
    id="LNT001",
    name="launch_file_missing",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="the launch stops there with an error",
    resolution="correct the path, or add the file",
    tier="stable",
)
_AT_START = "the node that it is given to stops when it starts"
_NOT_OPENED = "whoever opens it finds nothing"
_UNCALIBRATED = "camera_info_manager warns and goes on without a calibration"
_OPEN = frozenset("{}[]<>$!")
"""In a name that somebody fills in: of a template, or the default of a variable that has to be set."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report includes and parameter files of launch files that are not in their package, or found by chance only."""
    _ = workspace.systems  # evaluating launch files reports what is missing
    found: dict[tuple[str, str, bool], list[int]] = {}
    made = {package.name: frozenset(_made(package)) for package in workspace.packages}
    for entry in workspace.diagnostics("launch-include-missing", "launch-file-missing"):
        name = entry.about.removeprefix("/")  # of a package that is the root of the tree
        if _OPEN & set(name) or name.endswith("/"):
            continue  # the last part is for somebody to give
        if name.rpartition("/")[2] in made.get(workspace.package_of(name), ()):
            continue
        late = entry.code == "launch-file-missing" and workspace.files.ros_of(entry.path) == 2
        found.setdefault((entry.path, name, late), []).append(entry.line)
    for (path, name, late), lines in found.items():
        evidence = [Evidence(path, line) for line in lines]
        package = workspace.package_of(path)
        text = f"{path} names {_shown(name, package, workspace)}, which is not there"
        entity = Entity("file", workspace.in_package(name))
        yield RULE.finding(text, entity, package, evidence, consequence=_AT_START if late else "")
    yield from _relative(workspace)


def _made(package: PackageFacts) -> Iterator[str]:
    """Names of files that the build of a package makes of templates and by commands."""
    for command in (command for file in package.cmake.values() for command in file.commands):
        if command.name == "configure_file":
            yield from (name.rpartition("/")[2] for name in command.args[1:2])
        elif command.name == "add_custom_command" and command.args[:1] == ("OUTPUT",):
            outputs = takewhile(lambda word: not word.isupper(), command.args[1:])
            yield from (name.rpartition("/")[2] for name in outputs)


def tell(known: Known) -> Iterator[Finding]:
    """Report files that arguments and parameters name: maps, configurations, what rviz shows."""
    for found in absent_files(known):
        text = f"{found.place.path} names {found.path} of {found.package}, which is not there"
        text += f"; there is {found.near}" if found.near else ""
        text += f"; {found.archive} lies there, which may hold it" if found.archive else ""
        entity = Entity("file", f"{found.package}/{found.path}", found.near)
        yield RULE.finding(
            text,
            entity,
            found.consumer,
            [found.place],
            certainty="likely",
            severity="info" if found.is_url or found.archive else "warning",
            consequence=_UNCALIBRATED if found.is_url else _NOT_OPENED,
        )


def _relative(workspace: Workspace) -> Iterator[Finding]:
    """Includes that are there beside the file, where the launch looks from the folder that it is started in."""
    for entry in workspace.diagnostics("launch-include-relative"):
        name = entry.about
        package = workspace.package_of(entry.path)
        shown = _shown(name, package, workspace)
        text = f"{entry.path} finds {shown} only when it is started in its own folder"
        evidence = [Evidence(entry.path, entry.line)]
        yield RULE.finding(
            text,
            Entity("file", workspace.in_package(name)),
            package,
            evidence,
            certainty="likely",
            resolution=f"write $(dirname)/{name.removeprefix('./')}, or name the package",
        )


def _shown(path: str, package: str, workspace: Workspace) -> str:
    """A path of the own package as it is, one of another as that of its package, wherever that lies."""
    return path if workspace.package_of(path) == package else in_tree(workspace.in_package(path))
