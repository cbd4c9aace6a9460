"""LNT040: an analyzer cuts off the name of a node that nothing starts."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.diagnostics_yaml import Analyzer
from ecm_parsers.launch.model import Node
from ecm_parsers.launch.templates import all_actions, plain_text
from ecm_parsers.xml_tree import without_comments

from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT040",
    name="diagnostics_prefix_unknown",
    dimension="behavior",
    severity="warning",
    who="config",
    consequence="diagnostics keep their prefix, and who looks for them by name does not find them",
    resolution="write the name of the node that publishes them",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report prefixes of analyzers of a package whose launch files, which load them, start no node of that name."""
    names = _node_names(workspace)
    for package in workspace.packages:
        for path, file in package.aggregators.items():
            if not _is_loaded(path, package, workspace):
                continue
            for aggregator in file.aggregators:
                for analyzer in _all(aggregator.analyzers):
                    yield from _of(analyzer, path, package.name, names)


def _of(analyzer: Analyzer, path: str, package: str, names: set[str]) -> Iterator[Finding]:
    for prefix in (*analyzer.remove_prefix, *analyzer.find_and_remove_prefix):
        node = prefix.strip("/: ")
        if node.replace("_", "").isalnum() and node not in names:
            near = nearest(node, names)
            text = (
                f"remove_prefix of the analyzer {analyzer.key} is {node}, and no launch file starts a node of that name"
            )
            text += f"; one starts {near}" if near else ""
            evidence = [Evidence(path, analyzer.line)]
            yield RULE.finding(text, Entity("parameter", analyzer.key, node), package, evidence, certainty="likely")


def _all(analyzers: tuple[Analyzer, ...]) -> Iterator[Analyzer]:
    for analyzer in analyzers:
        yield analyzer
        yield from _all(analyzer.analyzers)


def _node_names(workspace: Workspace) -> set[str]:
    """Names of nodes that launch files give, and that programs give themselves."""
    found = {entry.node.rpartition("/")[2] for entry in workspace.linked if entry.node}
    for facts in workspace.launches.values():
        for action in all_actions(facts.actions):
            name = plain_text(action.name) if isinstance(action, Node) else None
            if name:
                found.add(name)
    return found | {node.name.rpartition("/")[2] for system in workspace.systems for node in system.nodes}


def _is_loaded(path: str, package: PackageFacts, workspace: Workspace) -> bool:
    """Tell whether a launch file of the package, which starts nodes, names the file, and all nodes are here."""
    name = path.rpartition("/")[2].encode()
    own = {path: facts for path, facts in workspace.launches.items() if workspace.package_of(path) == package.name}
    starts = any(
        name in without_comments(workspace.files.read(launch) or b"")
        and any(isinstance(action, Node) for action in all_actions(facts.actions))
        for launch, facts in own.items()
    )
    return starts and not _includes_others(package, workspace)


def _includes_others(package: PackageFacts, workspace: Workspace) -> bool:
    """Tell whether a launch file of the package includes one of another repository, whose nodes are not known."""
    _ = workspace.systems  # evaluating launch files reports it
    outside = workspace.diagnostics("launch-include-outside")
    return any(workspace.package_of(entry.path) == package.name for entry in outside)
