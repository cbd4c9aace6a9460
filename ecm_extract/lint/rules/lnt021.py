"""LNT021: packages depend on each other in a circle, or on a metapackage, or a metapackage cannot be configured."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import networkx as nx
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped_names

RULE = LintRule(
    id="LNT021",
    name="package_graph",
    dimension="versioning",
    severity="error",
    who="source",
    consequence="the build tool finds no order in which to build the workspace",
    resolution="remove one of the dependencies, or depend on the packages that are meant (REP 127)",
    of_one_tree=True,
)
_BUILDS = frozenset({"build", "build_export", "buildtool", "buildtool_export", "depend", "exec", "run"})


@cache
def known_metapackages() -> frozenset[str]:
    """Return the metapackages of ROS 1 distributions."""
    return shipped_names("lint/metapackages.toml", "ros1")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report circles once, and each dependency on a metapackage."""
    graph: nx.DiGraph[str] = nx.DiGraph()
    asked: dict[tuple[str, str], list[int]] = {}
    meta = {package.name for package in workspace.packages if is_meta(package)}
    known = known_metapackages() - workspace.by_name.keys()
    for package in workspace.packages:
        for entry in package.manifest.dependencies if package.manifest is not None else ():
            if entry.kind not in _BUILDS:
                continue
            if entry.name in workspace.by_name:
                graph.add_edge(package.name, entry.name)
            on_known = package.ros == 1 and entry.name in known
            if (entry.name in meta or on_known) and package.name not in meta and not package.root.rosbuild:
                asked.setdefault((package.name, entry.name), []).append(entry.line)
    for (name, other), lines in asked.items():
        yield _on_meta(workspace.by_name[name], other, lines)
    for circle in nx.strongly_connected_components(graph):
        if len(circle) > 1:
            yield _circle(sorted(circle), workspace)
    for name in sorted(meta):
        yield from _unbuildable(workspace.by_name[name])


def is_meta(package: PackageFacts) -> bool:
    """Tell whether a package only names others."""
    manifest = package.manifest
    return manifest is not None and any(entry.tag == "metapackage" for entry in manifest.exports)


def _on_meta(package: PackageFacts, name: str, lines: list[int]) -> Finding:
    text = f"{package.name} depends on the metapackage {name}"
    evidence = [Evidence(package.root.manifest or "", line) for line in lines]
    entity = Entity("package", package.name, name)
    consequence = "catkin warns each time that the workspace is configured, and more is installed than is used"
    return RULE.finding(text, entity, package.name, evidence, severity="info", consequence=consequence)


def _circle(names: list[str], workspace: Workspace) -> Finding:
    evidence = [Evidence(workspace.by_name[name].root.manifest or "", 1) for name in names]
    text = f"{', '.join(names)} depend on each other in a circle"
    return RULE.finding(text, Entity("package", " ".join(names)), names[0], evidence)


def _unbuildable(package: PackageFacts) -> Iterator[Finding]:
    manifest = package.manifest
    if manifest is None or package.ros == 2 or any(entry.kind == "buildtool" for entry in manifest.dependencies):
        return
    text = f"the metapackage {package.name} has no <buildtool_depend>catkin</buildtool_depend>"
    evidence = [Evidence(package.root.manifest or "", 1)]
    yield RULE.finding(text, Entity("package", package.name, "catkin"), package.name, evidence, severity="warning")
