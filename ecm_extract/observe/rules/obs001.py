"""A node runs, and an endpoint that its contract promises was not seen on it."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.conditions import LIFECYCLE
from ecm_extract.observe.expected import Expected, graph_keys, is_exact
from ecm_extract.observe.model import Endpoint
from ecm_extract.observe.rule import ObserveRule, line_of
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS001",
    name="endpoint_not_seen",
    dimension="signature",
    severity="error",
    who="graph",
    consequence="who counts on it waits for ever without an error",
    resolution="see why the node did not make it: a condition, a remap, or a start that hangs",
)


_CONFIGURED = frozenset({"inactive", "active"})


def check(watch: Watch) -> Iterator[Finding]:
    """Promises of the modules of each running node. Contracts carry no conditions, so this is never proved."""
    for node, promises in watch.expected_on.items():
        ends = watch.by_node.get(node, ())
        present = {*((end.role, end.name) for end in ends), *watch.helped}
        promised = {key for each in promises for key in graph_keys(each)}
        spare = [end for end in ends if (end.role, end.name) not in promised]
        for each in promises:
            if _is_missing(watch, each, present):
                yield _finding(watch, node, each, spare)


def _is_missing(watch: Watch, each: Expected, present: set[tuple[str, str]]) -> bool:
    """A parameter that is at its default need not be set anywhere, so it is never missing."""
    keys = graph_keys(each)
    visible = all(role in watch.seen.senses for role, _ in keys)
    is_parameter = each.interface.row.value
    return visible and not is_parameter and is_exact(each) and present.isdisjoint(keys)


def _waits_for_its_state(watch: Watch, node: str, each: Expected) -> bool:
    managed = any(wanted.subject == LIFECYCLE for wanted in each.module.preconditions or ())
    return managed and not any(state.node == node and state.name in _CONFIGURED for state in watch.seen.states)


def _finding(watch: Watch, node: str, each: Expected, spare: list[Endpoint]) -> Finding:
    """A spare endpoint of the same role and type on the node is most likely this one under another name.

    A managed node makes what it needs when it is configured, and nobody told that it is.
    """
    role = each.interface.role.replace("_", " ")
    entity = Entity(each.interface.role, each.name)
    same = [end.name for end in spare if (end.role, end.type) == (each.interface.role, each.interface.type)]
    subjects = (each.module.id, node)
    if same:
        text = f"{node} has no {role} {each.name}, but one of its type on {same[0]}, so it is most likely remapped"
        return RULE.seen(text, entity, subjects, line_of(each), certainty="likely", severity="info")
    text = f"{each.module.id} promises the {role} {each.name}, {node} does not have it"
    if _waits_for_its_state(watch, node, each):
        text += " and is a managed node that was not seen to be configured"
        return RULE.seen(text, entity, subjects, line_of(each), certainty="unknown", severity="info")
    return RULE.seen(text, entity, subjects, line_of(each), certainty="likely")
