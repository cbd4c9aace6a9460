"""LNT009: a plugin description names a class that the package does not define, or not export for that base class."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.plugin_xml import PluginClass

from ecm_extract.discover import is_test_path
from ecm_extract.link.spelling import plain
from ecm_extract.lint.plugin_bases import mismatches
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT009",
    name="plugin_not_exported",
    dimension="versioning",
    severity="error",
    who="source",
    consequence="the loader finds the description and then fails to create the class",
    resolution="make class, export macro and description agree",
)
_MACROS = re.compile(
    r"PLUGINLIB_\w*EXPORT\w*|PLUGINLIB_DECLARE_CLASS|RCLCPP_COMPONENTS_REGISTER_NODE|\w*REGISTER\w*|\w*EXPORT\w*"
)
_ARGUMENTS = re.compile(r"<(.+)>")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report described classes that no macro of the package exports, when it exports some with that macro at all.

    Not asked of the engine: macros that export classes are no provisions of a package yet.
    """
    yield from _of_other_base(workspace)
    for package in workspace.packages:
        exported = _exported(workspace, package)
        if not exported:
            continue
        for path, classes in package.plugins.items():
            for entry in classes if not is_test_path(path, package.root.path) else ():
                if _is_borrowed(entry, package, workspace) or _is_python(entry):
                    continue
                if not entry.type or _is_exported(entry, exported) or _is_of_other(entry, package, workspace):
                    continue
                if not _in_tests(entry, package, workspace):
                    yield _finding(entry, path, package, exported)


def _of_other_base(workspace: Workspace) -> Iterator[Finding]:
    """Classes that their macro exports for another base class than the description says."""
    for package, found in mismatches(workspace):
        entry = found.entry
        text = f"{found.path} describes {entry.type} as a {entry.base_class_type}, it is exported as a {found.base}"
        entity = Entity("plugin", entry.lookup_name, entry.base_class_type)
        yield RULE.finding(text, entity, package.name, [Evidence(found.path, entry.line), found.place])


def _is_of_other(entry: PluginClass, package: PackageFacts, workspace: Workspace) -> bool:
    """Tell whether the package that builds the library of a description, which is another one, exports the class."""
    library = _library(entry)
    others = [other for other in workspace.packages if other is not package and library in _targets(other)]
    wanted = {"".join(name.split()) for name in _names(entry.type)}
    return any(wanted & set(_exports(workspace, other)) for other in others)


def _is_borrowed(entry: PluginClass, package: PackageFacts, workspace: Workspace) -> bool:
    """Tell whether a description is of a library named after a dependency outside of the tree."""
    library = _library(entry)
    dependencies = package.manifest.dependencies if package.manifest is not None else ()
    return library not in workspace.by_name and any(each.name == library for each in dependencies)


def _is_python(entry: PluginClass) -> bool:
    """Tell whether a class is one of Python, which needs no macro."""
    return "::" not in entry.type and "." in entry.type


def _library(entry: PluginClass) -> str:
    return entry.library.rpartition("/")[2].removesuffix(".so").removeprefix("lib")


def _targets(package: PackageFacts) -> set[str]:
    targets = [target for file in package.cmake.values() for target in file.targets]
    return {name.removeprefix("lib") for target in targets for name in (target.name, target.output) if name}


def _exported(workspace: Workspace, package: PackageFacts) -> dict[str, tuple[str, int]]:
    """Return the classes that macros of a package export, by last name: (as written, line)."""
    found: dict[str, tuple[str, int]] = {}
    for name, place in _exports(workspace, package).items():
        found.setdefault(name.rpartition("::")[2], place)
    return found


def _exports(workspace: Workspace, package: PackageFacts) -> dict[str, tuple[str, int]]:
    """Return what macros of a package name, with the place of the first."""
    found: dict[str, tuple[str, int]] = {}
    for file in workspace.linker.program.files:
        for macro in file.facts.macros if file.package == package.name else ():
            for argument in macro.args if _MACROS.fullmatch(macro.name) else ():
                for name in _names(argument):
                    found.setdefault(name, (file.path, macro.line))
    return found


def _names(text: str) -> Iterator[str]:
    """A class, and what a factory template makes of it."""
    yield plain(text)
    inner = _ARGUMENTS.search(text)
    if inner is not None:
        yield plain(inner[1])


def _is_exported(entry: PluginClass, exported: dict[str, tuple[str, int]]) -> bool:
    return any(name.strip().rpartition("::")[2] in exported for name in _names(entry.type))


def _in_tests(entry: PluginClass, package: PackageFacts, workspace: Workspace) -> bool:
    """Tell whether a test source, which is not read otherwise, names the class."""
    last = entry.type.rpartition("::")[2].strip("> ").encode()
    tests = [each.path for each in package.root.files if is_test_path(each.path, package.root.path)]
    return any(last in (workspace.files.read(path) or b"") for path in tests if path.endswith((".cpp", ".hpp", ".h")))


def _finding(entry: PluginClass, path: str, package: PackageFacts, exported: dict[str, tuple[str, int]]) -> Finding:
    text = f"{path} describes {entry.type}, which no export macro of {package.name} names"
    evidence = [Evidence(path, entry.line), *(Evidence(*place) for place in sorted(exported.values())[:1])]
    return RULE.finding(
        text, Entity("plugin", entry.lookup_name, entry.type), package.name, evidence, certainty="likely"
    )
