"""A transform that a running module needs is nowhere in the tree of frames."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker import frames
from ecm_checker.finding import Certainty, Entity, Finding

from ecm_extract.observe.expected import is_exact, on_node
from ecm_extract.observe.rule import ObserveRule, line_of
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS011",
    name="transform_not_seen",
    dimension="signature",
    severity="error",
    who="graph",
    consequence="its lookups fail, and it drops data or waits for ever",
    resolution="start what publishes the transform, or correct the frame name",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Lookups of the modules that run against the frames that were seen connected."""
    if not watch.senses("transform"):
        return
    trees = frames.groups((each.parent, each.child) for each in watch.seen.transforms)
    for running in watch.present:
        node = running.node
        for each in on_node(running.module, None):
            ends = frames.ends(each.interface.frame) if each.interface.row.hears_transforms else None
            if ends is None or _connected(trees, *ends):
                continue
            text = f"{node} looks up {ends[0]} <- {ends[1]}: {_reason(trees, *ends)}"
            certainty: Certainty = "proved" if is_exact(each) else "likely"
            entity = Entity("transform", *ends)
            yield RULE.seen(text, entity, (running.module.id, node), line_of(each), certainty=certainty)


def _connected(trees: dict[str, str], one: str, two: str) -> bool:
    return one == two or (one in trees and trees[one] == trees.get(two))


def _reason(trees: dict[str, str], one: str, two: str) -> str:
    missing = [frame for frame in (one, two) if frame not in trees]
    return f"nobody sends {' and '.join(missing)}" if missing else "they are in two trees"
