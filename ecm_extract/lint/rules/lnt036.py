"""LNT036: something is used that its library, or a package of the workspace, has deprecated."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_checker.hub.kinds import kinds
from ecm_checker.hub.package import Provided

from ecm_extract.entities.public_files import public_headers, python_modules
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.index.call_index import call_index
from ecm_extract.lint.deprecations import deprecated_in
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt021 import is_meta
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import is_included

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
_PRIVATE = "_"
_FILE: Final = "file"


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report lines that the table of deprecations knows, and what the workspace itself has marked."""
    dead = {file.path for file in workspace.linker.program.files if not file.is_built}
    for package in workspace.packages:
        uses: dict[tuple[str, str, str], list[Evidence]] = {}
        for found in deprecated_in(package, workspace):
            uses.setdefault((found.old, found.new, found.since), []).append(Evidence(found.path, found.line))
        for (old, new, since), places in uses.items():
            text = f"{old} is deprecated since {since}; {new} replaces it"
            entity = Entity("function", old, new)
            built = [place for place in places if place.path not in dead]
            yield RULE.finding(
                text,
                entity,
                package.name,
                built or places,
                severity=None if built else "info",
                consequence="" if built else f"{RULE.consequence} (no target builds this file)",
                resolution=f"use {new}",
            )
    yield from _packages(workspace)
    yield from _functions(workspace)


def _packages(workspace: Workspace) -> Iterator[Finding]:
    """Dependencies on packages that say in their manifest that they are deprecated."""
    marked = {
        package.name: package.manifest.deprecated
        for package in workspace.packages
        if package.manifest is not None and package.manifest.deprecated is not None
    }
    told = (row for _, row in _told(workspace) if kinds()[row.kind].released)
    marked |= {row.name: row.deprecated for row in told if row.deprecated is not None}
    for package in workspace.packages:
        for entry in package.manifest.dependencies if package.manifest is not None else ():
            if entry.name in marked and package.name not in marked and not is_meta(package):
                reason = " ".join((marked[entry.name] or "").split())
                text = f"{package.name} depends on {entry.name}, which is deprecated" + (f" ({reason})" * bool(reason))
                place = [Evidence(package.root.manifest or "", entry.line)]
                yield RULE.finding(text, Entity("package", entry.name), package.name, place)


def _functions(workspace: Workspace) -> Iterator[Finding]:
    """Calls of functions whose every declaration of that name is marked, from outside of their class."""
    told = _functions_told(workspace)
    yield from _called_outside(workspace, told)
    marked = {
        name: functions
        for name, functions in workspace.linker.program.functions.items()
        if any(map(_has_mark, functions)) and not name.startswith(_PRIVATE)
    }
    visible = _visible(workspace.packages) if marked else frozenset()
    for name, functions in marked.items():
        is_told = all(_is_marked(row) for _, row in told.get(name, ()))
        for call in workspace.linker.sites.calls.get(name, ()) if is_told else ():
            user = call.func.file.package
            known = [each for each in functions if each.file.package == user or each.file.path in visible]
            yield from _called(name, call, known)


def _visible(packages: Iterable[PackageFacts]) -> frozenset[str]:
    """The files of which packages see each other's functions: what only a program has is called by no other one."""
    return frozenset(path for each in packages for path in (*public_headers(each), *python_modules(each)))


def _called(name: str, call: Invocation, known: Sequence[Func]) -> Iterator[Finding]:
    """The call of a function, by what its package knows of that name."""
    marked = _marked(known)
    homes = {each.cls for each in marked if each.cls is not None}
    file = call.func.file
    if marked and file is not marked[0].file and call.func.cls not in homes:
        places = [Evidence(file.path, call.line), Evidence(marked[0].file.path, marked[0].fact.line)]
        entity = Entity("function", f"{marked[0].fact.scope}::{name}")
        level: Severity | None = "info" if file.package == marked[0].file.package else None  # its author knows
        yield RULE.finding(f"{name} is deprecated", entity, file.package, places, certainty="likely", severity=level)


def _has_mark(func: Func) -> bool:
    return "deprecated" in func.fact.traits


_Rows = Sequence[tuple[str, Provided]]
"""What documents tell of packages beside the tree, with the names of these."""


def _told(workspace: Workspace) -> Iterator[tuple[str, Provided]]:
    """Yield the names that documents tell of packages beside the tree."""
    others = (each for each in workspace.stored if each.name not in workspace.by_name)
    return ((each.name, row) for each in others for row in each.provides)


def _functions_told(workspace: Workspace) -> Mapping[str, _Rows]:
    """The functions and methods of documents by their last part."""
    found: dict[str, list[tuple[str, Provided]]] = defaultdict(list)
    for package, row in _told(workspace):
        if kinds()[row.kind].called:
            found[last_name(row.name)].append((package, row))
    return found


def _is_marked(row: Provided) -> bool:
    """Tell whether a declaration carries the mark; a comment alone marks none of its forms."""
    return row.deprecated is not None and all(form.deprecated for form in row.forms)


def _called_outside(workspace: Workspace, told: Mapping[str, _Rows]) -> Iterator[Finding]:
    """Calls of what only documents declare."""
    program = workspace.linker.program
    modules = {(package, row.evidence[0].path): row.name for package, row in _told(workspace) if row.kind == _FILE}
    marked = {
        name: rows[0]
        for name, rows in told.items()
        if name not in program.functions and not name.startswith(_PRIVATE) and all(_is_marked(row) for _, row in rows)
    }
    calls = call_index(program, marked.keys(), frozenset())
    for name, (package, row) in marked.items():
        at = row.evidence[0]
        entity = Entity("function", f"{_scope(row, modules.get((package, at.path), ''))}::{name}")
        declared = Evidence(workspace.lines.of(package, at.path), at.line)
        for call in calls.get(name, ()):
            file = call.func.file
            places = [Evidence(file.path, call.line), declared]
            yield RULE.finding(f"{name} is deprecated", entity, file.package, places, certainty="likely")


def _scope(row: Provided, module: str) -> str:
    """What a function stands in, as its source says it: in Python without the module."""
    return (row.owner or row.name.rpartition("::")[0]).removeprefix(f"{module}.").replace(".", "::")


def _marked(known: Sequence[Func]) -> list[Func]:
    """The declarations of a name where all are marked; what a source file of their package defines is one of them."""
    declared = [each for each in known if each.file.language == "python" or is_included(each.file.path)]
    homes = {each.file.package for each in declared if _has_mark(each)}
    others = [each for each in known if each not in declared and each.file.package not in homes]
    return declared if all(map(_has_mark, declared)) and not others else []
