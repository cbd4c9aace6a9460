"""Modules together hold permissions that must not come together."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.grants import asked
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM009",
    name="permission_chain",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermChainSafe", "GlobalSafe"),
    consequence="the composition can do what no single module is allowed to, such as send camera images away",
    resolution="take one of the permissions from one of the modules, or run them apart",
)


def check(case: Case) -> Iterator[Finding]:
    """Unions of permissions against what the policy forbids together."""
    policy = case.profiles.policy
    if policy is None or not policy.forbidden_together:
        return
    held = {module.id: {name for _, name in asked(module)} for module in case.modules}
    for forbidden in policy.forbidden_together:
        holders = [module for module in case.modules if not held[module.id].isdisjoint(forbidden)]
        union = set().union(*(held[module.id] for module in holders))
        if union >= set(forbidden):
            text = f"together, {', '.join(each.id for each in holders)} hold {' and '.join(forbidden)}"
            evidence = [line for each in holders for line in each.evidence("permissions.data", "permissions.network")]
            yield RULE.finding(text, Entity("permissions", " ".join(sorted(forbidden))), holders, evidence)
