"""LNT042: a launch file names a node of the workspace by its absolute name, where the node itself is relative."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding, Severity
from ecm_parsers.launch.model import Action, Node, Remap, Substitution
from ecm_parsers.launch.templates import all_actions

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.model import Instance, Place

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
_MANAGER = 2
"""Of `load pkg/Class manager`, the arguments of a nodelet."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report remaps to topics of a node, and nodelet managers, each line once.

    No requirement of packages: how a name is written decides, in one evaluated system.
    """
    owners = {
        instance.full_name: instance.place
        for system in workspace.systems
        for instance in (node.instance for node in system.nodes)
        if instance.full_name and instance.namespace == "/" and instance.kind not in {"component", "controller"}
    }
    given = {
        (node.instance.full_name, remap.target)
        for system in workspace.systems
        for node in system.nodes
        for remap in node.instance.remaps
    }  # a node that is told to use the absolute name is met by it anywhere
    seen = set()
    included = workspace.included
    for system in workspace.systems:
        for node in system.nodes:
            for name, place in _absolute(node.instance):
                owner = "/" + name.split("/")[1]
                offered = (owner, name) in given
                if owner in owners and not offered and owner != node.name and (name, place) not in seen:
                    seen.add((name, place))
                    shared = place.path.rpartition("/")[2] in included and _is_written(place, workspace)
                    level = _IN_INCLUDED if shared else None
                    yield _finding(name, [place, owners[owner]], workspace, level)


def _absolute(instance: Instance) -> Iterator[tuple[str, Place]]:
    for remap in instance.remaps:
        if remap.target.startswith("/") and remap.target.count("/") > 1:
            yield remap.target, remap.place
    words = [word.text for word in instance.arguments]
    manager = words[_MANAGER] if instance.executable == "nodelet" and words[:1] == ["load"] and words[_MANAGER:] else ""
    if manager.startswith("/"):
        yield manager, instance.place


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


def _finding(name: str, places: list[Place], workspace: Workspace, level: Severity | None) -> Finding:
    text = f"{name} is absolute, and the node {name.split('/')[1]} is started by a relative name"
    package = workspace.package_of(places[0].path)
    evidence = [evidence_of(place) for place in places]
    return RULE.finding(text, Entity("topic", name), package, evidence, certainty="likely", severity=level)
