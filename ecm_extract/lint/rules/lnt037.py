"""LNT037: a metapackage leaves out a package that stands beside it."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt021 import is_meta
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.test_code import is_test_package

RULE = LintRule(
    id="LNT037",
    name="metapackage_incomplete",
    dimension="versioning",
    severity="info",
    who="config",
    consequence="who installs the metapackage gets it only through other packages, or not at all",
    resolution="add an <exec_depend> (<run_depend> in format 1) to the metapackage",
    of_one_tree=True,
)
_MOST = 0.6
_LEAST = 3
"""How many of its neighbours a metapackage must name before what it leaves out looks forgotten."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report packages in the folder of a metapackage that it does not name, when it names most of them."""
    for meta in workspace.packages:
        if meta.manifest is None or not is_meta(meta):
            continue
        beside = _beside(meta, workspace)
        named = {entry.name for entry in meta.manifest.dependencies} & beside
        if len(named) < _LEAST or len(named) < _MOST * len(beside):
            continue
        for name in sorted(beside - named):
            text = f"the metapackage {meta.name} does not name {name}, and it names {len(named)} of its neighbours"
            evidence = [Evidence(meta.root.manifest or "", meta.manifest.line or 1)]
            entity = Entity("package", meta.name, name)
            yield RULE.finding(text, entity, meta.name, evidence, certainty="likely")


def _beside(meta: PackageFacts, workspace: Workspace) -> set[str]:
    """Packages below the folder that holds the metapackage."""
    folder = meta.root.path.rpartition("/")[0]
    return {
        package.name
        for package in workspace.packages
        if package.root.path.startswith(f"{folder}/" if folder else "")
        and package is not meta
        and not is_meta(package)
        and not is_test_package(package.root.path)
    }
