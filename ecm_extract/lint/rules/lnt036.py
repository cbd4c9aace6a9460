"""LNT036: something is used that its library, or a package of the workspace, has deprecated."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.link.units import Func
from ecm_extract.lint.deprecations import deprecated_in
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt021 import is_meta
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT036",
    name="deprecated_used",
    dimension="versioning",
    severity="warning",
    who="source",
    consequence="it no longer builds or starts once the old name is gone",
    resolution="use what replaces it",
    tier="stable",
)
_HEADERS = (".h", ".hh", ".hpp", ".hxx")
_PRIVATE = "_"


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report lines that the table of deprecations knows, and what the workspace itself has marked."""
    for package in workspace.packages:
        uses: dict[tuple[str, str, str], list[Evidence]] = {}
        for found in deprecated_in(package, workspace):
            uses.setdefault((found.old, found.new, found.since), []).append(Evidence(found.path, found.line))
        for (old, new, since), places in uses.items():
            text = f"{old} is deprecated since {since}; {new} replaces it"
            entity = Entity("function", old, new)
            yield RULE.finding(text, entity, package.name, places, resolution=f"use {new}")
    yield from _packages(workspace)
    yield from _functions(workspace)


def _packages(workspace: Workspace) -> Iterator[Finding]:
    """Dependencies on packages that say in their manifest that they are deprecated."""
    marked = {
        package.name: package.manifest.deprecated
        for package in workspace.packages
        if package.manifest is not None and package.manifest.deprecated is not None
    }
    for package in workspace.packages:
        for entry in package.manifest.dependencies if package.manifest is not None else ():
            if entry.name in marked and package.name not in marked and not is_meta(package):
                reason = " ".join((marked[entry.name] or "").split())
                text = f"{package.name} depends on {entry.name}, which is deprecated" + (f" ({reason})" * bool(reason))
                place = [Evidence(package.root.manifest or "", entry.line)]
                yield RULE.finding(text, Entity("package", entry.name), package.name, place)


def _functions(workspace: Workspace) -> Iterator[Finding]:
    """Calls of functions whose every declaration of that name is marked, from outside of their class."""
    for name, functions in workspace.linker.program.functions.items():
        marked = [func for func in functions if "deprecated" in func.fact.traits]
        if not marked or name.startswith(_PRIVATE) or not _is_only(marked, functions):
            continue
        homes = {func.cls for func in marked if func.cls is not None}
        for call in workspace.linker.sites.calls.get(name, ()):
            if call.func.file is not marked[0].file and call.func.cls not in homes:
                text = f"{name} is deprecated"
                places = [Evidence(call.func.file.path, call.line), Evidence(marked[0].file.path, marked[0].fact.line)]
                entity = Entity("function", f"{marked[0].fact.scope}::{name}")
                user = call.func.file.package
                level: Severity | None = "info" if user == marked[0].file.package else None  # its author knows
                yield RULE.finding(text, entity, user, places, certainty="likely", severity=level)


def _is_only(marked: list[Func], functions: list[Func]) -> bool:
    """Only declarations carry the mark: what a source file defines is one of them."""
    declared = [func for func in functions if func.file.path.endswith((*_HEADERS, ".py"))]
    return len(declared) == len(marked)
