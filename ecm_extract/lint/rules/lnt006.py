"""LNT006: a remap of a launch file matches no name of its node."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.model import Remapping
from ecm_extract.system.names import absolute
from ecm_extract.system.node_model import SystemNode

RULE = LintRule(
    id="LNT006",
    name="remap_without_effect",
    dimension="signature",
    severity="warning",
    who="graph",
    consequence="the node keeps its own name and the two sides never meet",
    resolution="correct the name on the left side, or remove the remap",
)
_ELSEWHERE = (
    "/tf",
    "/tf_static",
    "tf",
    "tf_static",
    "/rosout",
    "/parameter_events",
    "/clock",
    "robot_description",
    "/diagnostics",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report remaps of nodes whose every name is known."""
    seen = set()
    for system in workspace.systems:
        for node in system.nodes:
            process = [other for other in system.nodes if other.instance.place == node.instance.place]
            if not node.modules or not node.endpoints or not all(_is_known(other) for other in process):
                continue
            for remap in node.instance.remaps:
                if all(_is_dead(remap, other) for other in process) and remap not in seen:
                    seen.add(remap)
                    yield _finding(remap, node, workspace)
    yield from _outvoted(workspace)


def _outvoted(workspace: Workspace) -> Iterator[Finding]:
    """Report remaps of names that a node lacks, where a second launch of its program remaps a name that it has.

    This holds for nodes of which some names are not known, too.
    """
    nodes = [node for system in workspace.systems for node in system.nodes if node.modules and node.instance.remaps]
    seen = set()
    for node in nodes:
        if _is_known(node):
            continue
        alive = {
            remap.target
            for other in nodes
            if _program(other) == _program(node) and other.instance.place != node.instance.place
            for remap in other.instance.remaps
            if not _is_dead(remap, other)
        }
        for remap in node.instance.remaps:
            if remap.target in alive and _is_dead(remap, node) and remap not in seen:
                seen.add(remap)
                yield _finding(remap, node, workspace)


def _program(node: SystemNode) -> tuple[str, str, str]:
    return node.instance.package, node.instance.executable, node.instance.plugin


def _is_known(node: SystemNode) -> bool:
    return bool(node.modules) and all(entry.known for entry in node.endpoints)


def _finding(remap: Remapping, node: SystemNode, workspace: Workspace) -> Finding:
    text = f"{node.name} has nothing called {remap.source}, so the remap to {remap.target} has no effect"
    package = workspace.package_of(remap.place.path)
    entity = Entity("remap", remap.source, remap.target)
    return RULE.finding(text, entity, package, [evidence_of(remap.place)], certainty="likely")


def _is_dead(remap: Remapping, node: SystemNode) -> bool:
    if remap.source.startswith(("__", "{")) or remap.source in _ELSEWHERE or "{" in remap.source:
        return False
    own = node.name.rpartition("/")[2]
    if "{" in node.name:
        return False
    source = absolute(remap.source, node.namespace, own)
    names = {entry.before for entry in node.endpoints}
    return not any(name == source or name.startswith(f"{source}/") or source.startswith(f"{name}/") for name in names)
