"""An endpoint runs with another QoS than its contract says."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.rule import ObserveRule, line_of
from ecm_extract.observe.watch import Pair, Watch

RULE = ObserveRule(
    id="OBS006",
    name="qos_differs",
    dimension="behavior",
    severity="warning",
    who="qos",
    consequence="what was checked with the QoS of the contract does not hold here",
    resolution="see which override sets it, and write it into the contract",
)
_POLICIES = ("reliability", "durability", "history", "depth", "deadline_ms", "lifespan_ms", "liveliness", "lease_ms")
_OPEN = frozenset({"system_default", "best_available", "unknown"})


def check(watch: Watch) -> Iterator[Finding]:
    """Policies that the contract fixes and that the source can see; ROS 1 has none."""
    for pair in watch.pairs if watch.senses("qos") and watch.seen.ros == 2 else ():
        different = [text for policy in _POLICIES for text in _difference(pair, policy)]
        if different:
            seen, module = pair.seen, pair.expected.module
            where = seen.node or "its endpoint"
            text = f"{seen.name}: {where} has {', '.join(different)} in the contract of {module.id}"
            entity = Entity("qos", seen.name, seen.role)
            yield RULE.seen(text, entity, (module.id, seen.node or seen.name), line_of(pair.expected))


def _difference(pair: Pair, policy: str) -> Iterator[str]:
    seen, wanted = pair.seen.qos, pair.expected.interface.qos
    if seen is None or wanted is None or policy in pair.seen.unseen or policy in wanted.defaulted:
        return
    has, says = getattr(seen, policy), getattr(wanted, policy)
    if says is None or says in _OPEN or (policy == "depth" and wanted.history == "keep_all"):
        return
    if has != says:
        yield f"{policy} {has if has is not None else 'infinite'} where it is {says}"
