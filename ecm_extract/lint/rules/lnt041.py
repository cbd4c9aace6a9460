"""LNT041: a target is compiled against generated headers and may be compiled before they are made."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.cmake_facts import Target

from ecm_extract.lint.catkin_targets import build_dependencies, generated_headers, included, own_headers
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT041",
    name="generated_header_unordered",
    dimension="versioning",
    severity="warning",
    who="source",
    consequence="a clean or parallel build stops now and then, because the header is not there yet",
    resolution="add_dependencies(TARGET ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})",
    of_one_tree=True,
    tier="stable",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report targets of catkin packages; headers of another package are made first unless all is built at once."""
    headers = generated_headers(workspace.packages)
    if not headers:
        return
    for package in workspace.packages:
        if package.ros != 1 or package.root.rosbuild:
            continue
        own = own_headers(package)
        for path, file in package.cmake.items():
            ordered = build_dependencies(file)
            for target in file.targets:
                if target.kind in {"executable", "library"} and not target.is_test:
                    yield from _of(target, path, package, ordered, _used(package, own, _sources(target, path), headers))


def _sources(target: Target, path: str) -> list[str]:
    folder = path.rpartition("/")[0]
    return [f"{folder}/{source}" if folder else source for source in target.sources]


def _used(
    package: PackageFacts, own: Mapping[str, Sequence[str]], sources: Sequence[str], headers: Mapping[str, str]
) -> dict[str, str]:
    """Packages whose generated headers a target includes, directly or through headers, each with one of them."""
    found: dict[str, str] = {}
    for source in sources:
        for header in included(package, own, source):
            if header in headers and not _is_checked_in(header, package):
                found.setdefault(headers[header], header)
    return found


def _is_checked_in(header: str, package: PackageFacts) -> bool:
    """Tell whether the package holds the header itself, so that it is there before anything is made."""
    return any(f"/{path}".endswith(f"/include/{header}") for path in package.sources)


def _of(
    target: Target, path: str, package: PackageFacts, ordered: Mapping[str, set[str]], used: Mapping[str, str]
) -> Iterator[Finding]:
    names = _closure(target.name, ordered)
    for owner, header in used.items():
        own = owner == package.name
        if any(_makes(name, owner, own) for name in names):
            continue
        text = f"target {target.name} includes {header} and does not wait for {owner} to make it"
        evidence = [Evidence(path, target.line)]
        entity = Entity("library", target.name, owner)
        yield RULE.finding(
            text, entity, package.name, evidence, certainty="likely", severity="warning" if own else "info"
        )


def _closure(target: str, ordered: Mapping[str, set[str]]) -> set[str]:
    found: set[str] = set()
    pending = [target]
    while pending:
        name = pending.pop()
        new = ordered.get(name, set()) - found
        found |= new
        pending += new
    return found


def _makes(name: str, owner: str, own: bool) -> bool:
    """Tell whether a name in add_dependencies stands for the headers of a package."""
    makes = name.startswith((f"{owner}_gen", f"{owner}_EXPORTED", f"${{{owner}_EXPORTED"))
    return makes or (not own and "catkin_EXPORTED_TARGETS" in name)
