"""A node that the launch starts was not seen."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS019",
    name="node_not_running",
    dimension="recovery",
    severity="error",
    who="graph",
    consequence="everything that it does is missing, and nobody is told",
    resolution="read its log; let the launch respawn it or end with it",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Nodes of the launch without one of that name; contracts of a workspace need not all run."""
    if not watch.launched or not watch.senses("node"):
        return
    for module in watch.absent:
        interfaces = module.contract.signature.interfaces
        evidence = [line for each in interfaces[:1] for line in each.evidence[:1]]
        text = f"the launch starts {module.id}, and no node of its name was seen"
        yield RULE.seen(text, Entity("node", module.id), (module.id,), evidence)
