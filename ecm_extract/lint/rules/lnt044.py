"""LNT044: a package exports a library that it does not build, or does not install."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.cmake_facts import Command

from ecm_extract.lint.install_rules import lives_in_devel_space
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt043 import installed_targets, is_open
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT044",
    name="exported_library_missing",
    dimension="versioning",
    severity="warning",
    who="source",
    consequence="every package that depends on it fails to configure or to link",
    resolution="make name, target and install(TARGETS ...) agree",
)
_EXPORTS = {"catkin_package": "LIBRARIES", "ament_export_libraries": ""}
_OTHER = frozenset({"INCLUDE_DIRS", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS"})


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report exported names that look like the package's own; what is installed is known when every rule is."""
    everywhere = {name for package in workspace.packages for name in _built(package)}
    for package in workspace.packages:
        built = _built(package)
        if package.root.rosbuild or any("$" in name for name in built):
            continue
        if any(file.unknown for file in package.cmake.values()):
            continue
        is_unknown = is_open(package) or lives_in_devel_space(package)
        installed = None if is_unknown else _installed(package)
        for path, file in package.cmake.items():
            for command in file.commands:
                for name in _exported(command):
                    reason = _reason(name, built, installed)
                    foreign = name not in built and (name in everywhere or _family(name) != _family(package.name))
                    if reason and not foreign:
                        yield _finding(package, name, reason, Evidence(path, command.line))


def _built(package: PackageFacts) -> set[str]:
    targets = [target for file in package.cmake.values() for target in file.targets]
    return {
        name for each in targets if each.kind in {"library", "interface"} for name in (each.name, each.output) if name
    }


def _installed(package: PackageFacts) -> set[str]:
    """Names of installed targets, and of the files that they make."""
    found = installed_targets(package)
    targets = [target for file in package.cmake.values() for target in file.targets]
    return found | {target.output for target in targets if target.name in found}


def _family(name: str) -> str:
    """The first word of a name: what shares none with its package is a library of the system."""
    return name.partition("_")[0]


def _exported(command: Command) -> Iterator[str]:
    """Names after LIBRARIES, or all of them."""
    if command.name not in _EXPORTS:
        return
    taken = not _EXPORTS[command.name]
    for argument in command.args:
        if argument == _EXPORTS[command.name] or argument in _OTHER:
            taken = argument == _EXPORTS[command.name]
        elif taken and argument and not {"$", "/", "."} & set(argument):
            yield argument


def _reason(name: str, built: set[str], installed: set[str] | None) -> str:
    if name not in built:
        return "does not build"
    return "does not install" if installed is not None and name not in installed else ""


def _finding(package: PackageFacts, name: str, reason: str, place: Evidence) -> Finding:
    text = f"{package.name} exports the library {name}, which it {reason}"
    return RULE.finding(text, Entity("library", name, reason), package.name, [place], certainty="likely")
