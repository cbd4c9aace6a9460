"""LNT004: a launch file or description uses a package that package.xml does not name."""

from __future__ import annotations

from collections.abc import Iterator

import networkx as nx
from ecm_checker.contract import Evidence
from ecm_checker.finding import Depend, Entity, Finding, Severity
from ecm_checker.hub.package import Package
from ecm_parsers.package_references import parse_references

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT004",
    name="dependency_undeclared",
    dimension="versioning",
    severity="info",
    who="config",
    consequence="on a machine that has only what package.xml asks for, the launch stops with 'package not found'",
    resolution="add an <exec_depend> (<run_depend> in format 1) to package.xml",
    tier="stable",
)
_FILES = (".launch", ".launch.xml", ".launch.py", "_launch.py", ".xacro", ".urdf", ".launch.yaml")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each package once for the package that uses it, with its first lines.

    It is a warning where the used package is in the tree and nothing that is asked for brings it along: what is
    installed from elsewhere may bring a package that is released, and not one of this tree.
    """
    reach = _Reach(workspace)
    for package in workspace.packages:
        if package.manifest is None:
            continue
        declared = {entry.name for entry in package.manifest.dependencies} | {package.name} | workspace.externals
        for name, lines in _used(workspace, package).items():
            if name not in declared:
                text = f"{package.name} uses {name}, which its package.xml does not name"
                level: Severity = "warning" if reach.is_absent(package.name, name) else "info"
                entity, edit = Entity("package", name), Depend(name, "run")
                yield RULE.finding(text, entity, package.name, lines[:5], severity=level, edit=edit)


class _Reach:
    """What the packages of the workspace, and those of documents beside it, bring along when they are installed."""

    def __init__(self, workspace: Workspace) -> None:
        manifests = [package.manifest for package in workspace.packages if package.manifest is not None]
        others = [each for each in workspace.stored if each.name not in workspace.by_name]
        self._own = frozenset((*workspace.by_name, *(each.name for each in others)))
        self._graph: nx.DiGraph[str] = nx.DiGraph()
        self._graph.add_nodes_from(sorted(self._own))
        self._graph.add_edges_from((item.name, entry.name) for item in manifests for entry in item.dependencies)
        self._graph.add_edges_from((each.name, name) for each in others for name in _needed(each))
        self._wanted = self._graph.copy()
        edges = ((package.name, used) for package in workspace.packages for used in _used(workspace, package))
        named = ((each.name, row.package) for each in others for row in each.requires if row.package)
        both = (*edges, *named)
        self._wanted.add_edges_from((name, used) for name, used in both if {name, used} <= self._own)

    def is_absent(self, package: str, used: str) -> bool:
        """Tell whether `used` is of the tree, is not brought along, and could be asked for without a circle.

        Two packages that use each other cannot both ask for the other.
        """
        if used not in self._own or nx.has_path(self._graph, package, used):
            return False
        return not nx.has_path(self._wanted, used, package)


def _needed(document: Package) -> Iterator[str]:
    """What the manifest of a package names."""
    return (row.name for row in document.requires if row.row.brings and row.evidence[0].path == document.manifest)


def _used(workspace: Workspace, package: PackageFacts) -> dict[str, list[Evidence]]:
    found: dict[str, list[Evidence]] = {}
    for entry in package.root.files:
        if not _is_read(entry.path, package):
            continue
        read = workspace.files.parsed(entry.path, parse_references)
        for named in read.facts if read is not None else ():
            found.setdefault(named.package, []).append(Evidence(entry.path, named.line))
    return found


def _is_read(path: str, package: PackageFacts) -> bool:
    """Launch files and descriptions that are installed as they are: no test, no template."""
    hidden = "/." in f"/{path}"  # editors keep copies there
    return (
        path.endswith(_FILES) and "/templates/" not in path and not hidden and not is_test_path(path, package.root.path)
    )
