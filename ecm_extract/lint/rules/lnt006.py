"""LNT006: a remap of a launch file matches no name of its node."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.link.spelling import last_name
from ecm_extract.lint.lines import line_of_name
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.lint.written_names import WrittenNames
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

_PATH = re.compile(r"\w/\w")
_FRAMEWORK = re.compile(
    r"Node|Interface|Controller|Plugin|Base|^Q[A-Z]|^(?:enable_shared_from_this|object|ABC|Thread|Generic)$"
)
"""Bases that bring no names, by how they are called."""
_MARKUP = (".launch", ".xml", ".yaml", ".yml")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report remaps of nodes whose every name is known.

    No requirement of packages: the other side is a node of one evaluated system, not a package.
    """
    seen = set()
    written = WrittenNames(workspace)
    for system in workspace.systems:
        alive = _alive(system.nodes)
        for node in system.nodes:
            process = [other for other in system.nodes if other.instance.place == node.instance.place]
            if not node.modules or not node.endpoints or not all(_is_known(other) for other in process):
                continue
            if any(_has_foreign_base(other, workspace) for other in process):
                continue
            for remap in node.instance.remaps:
                dead = all(_is_dead(remap, other) for other in process)
                if not dead or remap in seen or _key(remap) in alive or _is_written(remap, process, written):
                    continue
                seen.add(remap)
                yield _finding(remap, node, workspace)
    yield from _outvoted(workspace)


def _key(remap: Remapping) -> tuple[str, int, str, str]:
    """One remap, or in Python one list of them, as several nodes may get it."""
    line = remap.place.line if remap.place.path.endswith(_MARKUP) else 0
    return remap.place.path, line, remap.source, remap.target


def _alive(nodes: Sequence[SystemNode]) -> set[tuple[str, int, str, str]]:
    """Remaps that some node may need: one of a group, or of a list for several nodes, is right for one of them."""
    return {
        _key(remap)
        for node in nodes
        for remap in node.instance.remaps
        if not _is_known(node) or not _is_dead(remap, node)
    }


def _is_written(remap: Remapping, process: Sequence[SystemNode], written: WrittenNames) -> bool:
    """Tell whether a package of the nodes has the name in a place where no known endpoint is: a helper may use it."""
    modules = [module for node in process for module in node.modules]
    packages = {module.package for module in modules}
    if _PATH.search(remap.source):  # plugins of other packages get the node handed in
        return written.anywhere(remap.source)
    return any(written.holds(package, remap.source) for package in packages)


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


def _has_foreign_base(node: SystemNode, workspace: Workspace) -> bool:
    """Tell whether a node derives from a class outside of the tree that may have names of its own."""
    program = workspace.linker.program
    names = {module.cls for module in node.modules}
    classes = [cls for name in names for cls in program.classes.get(last_name(name), ()) if cls.qualified == name]
    known = {entry.fact.name for cls in classes for entry in program.ancestry(cls)}
    names = {last_name(name) for cls in classes for name in program.base_names(cls)}
    return any(name not in known and _FRAMEWORK.search(name) is None for name in names)


def _finding(remap: Remapping, node: SystemNode, workspace: Workspace) -> Finding:
    target = f"the remap to {remap.target}" if remap.target else "its remap"
    text = f"{node.name} has nothing called {remap.source}, so {target} has no effect"
    package = workspace.package_of(remap.place.path)
    entity = Entity("remap", remap.source, remap.target)
    line = line_of_name(remap.place.path, remap.place.line, remap.source, workspace)
    return RULE.finding(text, entity, package, [Evidence(remap.place.path, line)], certainty="likely")


def _is_dead(remap: Remapping, node: SystemNode) -> bool:
    if remap.source.startswith(("__", "{")) or remap.source in _ELSEWHERE or "{" in remap.source:
        return False
    own = node.name.rpartition("/")[2]
    if "{" in node.name:
        return False
    source = absolute(remap.source, node.namespace, own)
    if source.endswith("/camera_info") and any(entry.type == "sensor_msgs/msg/Image" for entry in node.endpoints):
        return False  # a camera subscriber takes it from beside its image
    names = {entry.before for entry in node.endpoints}
    return not any(name == source or name.startswith(f"{source}/") or source.startswith(f"{name}/") for name in names)
