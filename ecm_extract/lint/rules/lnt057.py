"""LNT057: what is installed links a library of the same package that is not installed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.cmake_facts import Target

from ecm_extract.entities.install_rules import installed_targets, is_open
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT057",
    name="library_not_installed",
    dimension="versioning",
    severity="error",
    who="source",
    consequence="where the package is installed, it does not start: 'cannot open shared object file'",
    resolution="add the library to install(TARGETS ...)",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report shared libraries, each once with an installed target that needs it."""
    for package in workspace.packages:
        installed = installed_targets(package)
        if not installed or package.root.rosbuild or is_open(package):
            continue
        targets = {target.name: (path, target) for path, file in package.cmake.items() for target in file.targets}
        shared = {name for name, (_, target) in targets.items() if target.is_shared and not target.is_test}
        seen: set[str] = set()
        for name in sorted(installed & targets.keys()):
            for library in _linked(name, targets):
                if library in shared - installed - seen:
                    seen.add(library)
                    path, target = targets[library]
                    text = f"{package.name} installs {name}, which links {library}, and does not install {library}"
                    entity = Entity("library", library)
                    yield RULE.finding(text, entity, package.name, [Evidence(path, target.line)], certainty="proved")


def _linked(name: str, targets: dict[str, tuple[str, Target]]) -> Iterator[str]:
    """Targets of the package that a target needs, directly or through others."""
    pending, seen = [name], {name}
    while pending:
        for link in targets[pending.pop()][1].links:
            inner = link.rpartition("::")[2]
            if inner in targets and inner not in seen:
                seen.add(inner)
                pending.append(inner)
                yield inner
