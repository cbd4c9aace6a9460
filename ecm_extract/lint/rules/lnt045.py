"""LNT045: a launch file names a topic of a node by a path where nothing starts that node."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.model import Instance, Remapping
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.reached import reached

RULE = LintRule(
    id="LNT045",
    name="node_in_other_namespace",
    dimension="signature",
    severity="warning",
    who="graph",
    consequence="the two sides never meet, without an error",
    resolution="put both into one namespace, or name the whole path",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report absolute remap targets whose first part is a node that is started in namespaces only."""
    nodes = [node for system in workspace.systems for node in system.nodes]
    called: dict[str, list[SystemNode]] = defaultdict(list)
    for node in nodes:
        name = node.instance.full_name or ""
        if name and "{" not in name:
            called[name.rpartition("/")[2]].append(node)
    users = _users(nodes)
    lost: dict[Remapping, Instance] = {}
    for each in reached(nodes, [node.instance for node in nodes]):
        if each.remap is not None and each.match.state == "dangling" and not users[each.name] - {each.node.name}:
            others = [other for other in called[_first(each.name)] if _may_have(other, each.remap)]
            if others and "{" not in each.name:
                lost.setdefault(each.remap, others[0].instance)
    for remap, other in lost.items():
        yield _finding(remap, other, workspace)


def _users(nodes: Iterable[SystemNode]) -> Mapping[str, set[str]]:
    """The nodes that use a name, by themselves or by a remap: where two do, they meet there."""
    users: dict[str, set[str]] = defaultdict(set)
    for node in nodes:
        for name in (*(entry.name for entry in node.endpoints), *(remap.target for remap in node.instance.remaps)):
            users[name].add(node.name)
    return users


def _may_have(node: SystemNode, remap: Remapping) -> bool:
    """Tell whether a node has such a private name, or its code is not in the tree."""
    tail = remap.target.split("/", 2)[2]
    own = {f"{node.name}/{tail}", f"{node.name.rpartition('/')[0]}/{tail}"}
    unknown = not node.modules and not node.endpoints
    return unknown or any(own & {entry.name, entry.before} for entry in node.endpoints)


def _first(name: str) -> str:
    """The first part of `/node/topic`."""
    return name.split("/")[1]


def _finding(remap: Remapping, other: Instance, workspace: Workspace) -> Finding:
    text = f"{remap.target} is a name of the node /{_first(remap.target)}, and only {other.full_name} is started"
    package = workspace.package_of(remap.place.path)
    evidence = [evidence_of(remap.place), evidence_of(other.place)]
    entity = Entity("remap", remap.target, other.full_name or "")
    return RULE.finding(text, entity, package, evidence, certainty="likely")
