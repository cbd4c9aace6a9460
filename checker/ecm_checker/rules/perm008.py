"""A module comes from a release channel that may not run here."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.demand import undeclared
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM008",
    name="release_channel_not_permitted",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="a module runs here that was not tested for it",
    resolution="promote the release to a channel that is allowed, or deploy it elsewhere",
)


def check(case: Case) -> Iterator[Finding]:
    """Channels of modules against those that the policy allows."""
    policy = case.profiles.policy
    if policy is None or policy.release_channels is None:
        return
    for module in case.modules:
        channel = module.contract.ecm.release_channel
        if channel is not None and channel not in policy.release_channels:
            text = f"{module.id} is {channel}, allowed are {', '.join(policy.release_channels)}"
            yield RULE.finding(text, Entity("channel", channel), (module,))
    silent = [module for module in case.modules if module.runs and module.contract.ecm.release_channel is None]
    yield from undeclared(RULE, "ecm.release_channel", silent)
