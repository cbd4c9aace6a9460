"""LNT042: a launch file names a node of the workspace by its absolute name, where the node itself is relative."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_checker.hub.provision import Provision
from ecm_parsers.launch.model import Action, Node, Remap
from ecm_parsers.launch.templates import all_actions
from ecm_parsers.template import Substitution

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.model import Place
from ecm_extract.system.reached import Reached, reached

RULE = LintRule(
    id="LNT042",
    name="absolute_name_of_node",
    dimension="signature",
    severity="info",
    who="graph",
    consequence="started in a namespace, for a second robot, the two no longer meet",
    resolution="leave the leading / out",
)
_IN_INCLUDED: Severity = "warning"
"""Who includes a file may put it in a namespace; a file that is started itself chooses its own."""
_HANDED = "hand the name to the launch file as an argument: without its / it would lie in the namespace of this node"
_HOSTED = frozenset({"component", "controller"})
"""Kinds of nodes that are named by what holds them."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report remaps to topics of a node, and nodelet managers, each line once."""
    nodes = [node for system in workspace.systems for node in system.nodes]
    relative = [each.instance for each in nodes if each.instance.namespace == "/" and each.instance.kind not in _HOSTED]
    told = {(node.instance.full_name, remap.target) for node in nodes for remap in node.instance.remaps}
    beside = _started_with(workspace)
    seen: set[Place] = set()
    for each in reached(nodes, relative):
        for owner in each.nodes:
            is_met = owner.name == each.node.name or (owner.name, each.name) in told  # who is told so is there anywhere
            if not is_met and each.place not in seen:  # one line may name the node of each of many robots
                seen.add(each.place)
                yield _finding(each, owner, workspace, together=owner.name in beside[each.place])


def _started_with(workspace: Workspace) -> Mapping[Place, frozenset[str]]:
    """Names of the nodes that some launch starts together with what a line tells a name."""
    found: dict[Place, frozenset[str]] = defaultdict(frozenset)
    for system in workspace.systems:
        names = frozenset(node.name for node in system.nodes)
        for node in system.nodes:
            for place in (node.instance.place, *(remap.place for remap in node.instance.remaps)):
                found[place] |= names
    return found


def _is_written(place: Place, workspace: Workspace) -> bool:
    """Tell whether the name stands where it is remapped: whoever gives it as an argument knows the namespace."""
    file = workspace.launches.get(place.path)
    remaps = (each for action in all_actions(file.actions) for each in _remaps(action)) if file is not None else ()
    return not any(each.line == place.line and _is_given(each) for each in remaps)


def _remaps(action: Action) -> tuple[Remap, ...]:
    if isinstance(action, Remap):
        return (action,)
    return action.remaps if isinstance(action, Node) else ()


def _is_given(remap: Remap) -> bool:
    first = remap.target[0] if remap.target else None
    return isinstance(first, Substitution) and first.kind == "arg"


def _finding(found: Reached, owner: Provision, workspace: Workspace, *, together: bool) -> Finding:
    """A finding; a node that no launch starts together with what is told may have the name by chance: an info."""
    shared = found.place.path.rpartition("/")[2] in workspace.included and _is_written(found.place, workspace)
    text = f"{found.name} is absolute, and the node {owner.name.lstrip('/')} is started by a relative name"
    beside = _is_beside(found)
    return RULE.finding(
        text,
        Entity("topic", found.name),
        workspace.package_of(found.place.path),
        [evidence_of(found.place), Evidence(owner.path, owner.line)],
        certainty="likely",
        severity=_IN_INCLUDED if shared and together and beside else None,
        resolution=RULE.resolution if beside else _HANDED,
    )


def _is_beside(found: Reached) -> bool:
    """Tell whether the name without its slash is the same one: who is told it is in no namespace of its own."""
    return found.node.namespace == "/"
