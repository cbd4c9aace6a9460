"""What only one module may hold is claimed by several that run."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding

from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Running, Watch

RULE = ObserveRule(
    id="OBS010",
    name="lock_held_by_another",
    dimension="resources",
    severity="error",
    who="safety",
    consequence="the second claim is refused, or both drive the hardware against each other",
    resolution="stop or deactivate one of them before the other starts",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Exclusive locks of the contracts of nodes that run at once."""
    holders: defaultdict[str, list[Running]] = defaultdict(list)
    for running in watch.running:
        for lock in running.module.locks or ():
            holders[lock].append(running)
    for lock, found in holders.items():
        nodes = sorted({each.node for each in found})
        if len(nodes) > 1:
            text = f"{lock} is claimed by {', '.join(nodes)}, which all run"
            # In another namespace there may be another controller manager with hardware of its own.
            certainty: Certainty = "proved" if len({node.rpartition("/")[0] for node in nodes}) == 1 else "likely"
            yield RULE.seen(text, Entity("claim", lock), nodes, _lines(found), certainty=certainty)


def _lines(found: list[Running]) -> list[Evidence]:
    return [line for each in found for line in each.module.evidence("resources.exclusive_locks")[:1]]
