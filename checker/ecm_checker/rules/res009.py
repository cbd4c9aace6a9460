"""A module needs an exclusive resource that another one already holds."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES009",
    name="lock_held",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("LockSafe", "AllocSat"),
    consequence="the claim is refused, or both drive the hardware against each other",
    resolution="stop the holder first, or let the two take turns",
)


def check(case: Case) -> Iterator[Finding]:
    """Locks of modules against those that the runtime says are held."""
    runtime = case.profiles.runtime
    for claim, modules in case.claims.items() if runtime is not None else ():
        assert runtime is not None
        holder = runtime.locks.get(claim)
        for module in modules:
            if holder is not None and holder != module.id:
                text = f"{module.id} needs {claim}, which {holder} holds"
                evidence = module.evidence("resources.exclusive_locks")
                yield RULE.finding(text, Entity("claim", claim, holder), (module,), evidence)
