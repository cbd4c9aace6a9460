"""The tree of frames is none: a loop, a frame with several parents, or a transform that jumps."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.model import Transform
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS012",
    name="transform_tree_broken",
    dimension="signature",
    severity="error",
    who="safety",
    consequence="lookups give whichever answer came last, or fail",
    resolution="let exactly one node send each transform",
)
_JUMP_M = 1.0
_FASTEST_M_S = 50.0


def check(watch: Watch) -> Iterator[Finding]:
    """Loops and several parents are proved; a jump is what no robot can drive."""
    sent = watch.seen.transforms
    yield from _several_parents(sent)
    yield from _loops(sent)
    yield from _several_writers(sent)
    yield from _jumps(sent)


def _several_parents(sent: Iterable[Transform]) -> Iterator[Finding]:
    parents: defaultdict[str, set[str]] = defaultdict(set)
    for each in sent:
        parents[each.child].add(each.parent)
    for child, found in parents.items():
        if len(found) > 1:
            text = f"{child} has {len(found)} parents: {', '.join(sorted(found))}"
            yield RULE.seen(text, Entity("frame", child, "parents"), (child,))


def _loops(sent: Iterable[Transform]) -> Iterator[Finding]:
    """Follow the last parent of each frame; each loop is told once, from its first frame."""
    parent = {each.child: each.parent for each in sent}
    done: set[str] = set()
    for start in sorted(parent):
        path: list[str] = []
        frame: str | None = start
        while frame is not None and frame not in done and frame not in path:
            path.append(frame)
            frame = parent.get(frame)
        if frame in path:
            loop = path[path.index(frame) :]
            text = f"frames form a loop: {' -> '.join([*loop, frame])}"
            yield RULE.seen(text, Entity("frame", min(loop), "loop"), sorted(loop))
        done.update(path)


def _several_writers(sent: Iterable[Transform]) -> Iterator[Finding]:
    for each in sent:
        if len(each.writers) > 1 and not each.static:
            text = f"{each.parent} -> {each.child} is sent by {', '.join(each.writers)}"
            yield RULE.seen(text, Entity("frame", each.child, "writers"), each.writers, certainty="likely")


def _jumps(sent: Iterable[Transform]) -> Iterator[Finding]:
    for each in sent:
        if each.largest_step_m > max(_JUMP_M, _FASTEST_M_S * each.step_s):
            text = f"{each.parent} -> {each.child} jumps by {each.largest_step_m:.3g} m in {each.step_s:.3g} s"
            yield RULE.seen(text, Entity("frame", each.child, "jump"), (each.child,), certainty="likely")
