"""What modules must be allowed to do, and what of it a policy does not allow."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final

import msgspec

from ecm_checker.case import Case
from ecm_checker.demand import undeclared
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.profiles import Policy
from ecm_checker.rule import Rule
from ecm_checker.units import number
from ecm_checker.view import View

AUDIT_LEVELS: Final = ("none", "basic", "standard", "full")
HUMAN: Final = frozenset({"human_contact", "human_proximity"})


class Denied(msgspec.Struct, frozen=True):
    """A permission that is asked for and not granted; `unknown` when the policy does not say."""

    kind: str
    name: str
    text: str
    certainty: Certainty = "proved"


DeniedBy = Callable[[View, Policy], Iterator[Denied]]


def denied_findings(case: Case, rule: Rule, field: str, denied: DeniedBy) -> Iterator[Finding]:
    """Findings of a rule for permissions that the policy does not grant."""
    policy = case.profiles.policy
    if policy is None:
        return
    for module in case.modules:
        for each in denied(module, policy):
            text = f"{module.id} asks for {each.name}: {each.text}"
            evidence = module.evidence(f"permissions.{field}")
            yield rule.finding(text, Entity(each.kind, each.name), (module,), evidence, certainty=each.certainty)
    if denied not in _PART_OF_A_FIELD:
        yield from _silent_findings(case, rule, field, policy)


def _silent_findings(case: Case, rule: Rule, field: str, policy: Policy) -> Iterator[Finding]:
    """One finding for all modules that do not say what they must be allowed, where the policy restricts it."""
    if field in _DECIDED and getattr(policy, field) not in (None, True):
        silent = [module for module in case.modules if module.runs and getattr(module, field) is None]
        yield from undeclared(rule, f"permissions.{field}", silent)


def scopes(module: View, policy: Policy) -> Iterator[Denied]:
    """Motion scopes and zones that are not granted; limits and human contact are asked about elsewhere."""
    wanted = {key: item for key, item in _physical(module).items() if key not in HUMAN and number(item) is None}
    yield from _not_granted(wanted, policy)


def contact(module: View, policy: Policy) -> Iterator[Denied]:
    """Nearness to people that is not granted, or nearer than granted (metres)."""
    wanted = {key: item for key, item in _physical(module).items() if key in HUMAN}
    granted = policy.physical or {}
    for key, item in wanted.items():
        asked, least = number(item), number(granted.get(key))
        if asked is not None and least is not None and asked < least:
            yield Denied("physical", key, f"as near as {asked:g} m, the policy allows {least:g} m")
        elif asked is None or least is None:
            yield from _not_granted({key: item}, policy)


def limits(module: View, policy: Policy) -> Iterator[Denied]:
    """Forces and speeds above the limit of the policy."""
    granted = policy.physical or {}
    for key, item in _physical(module).items():
        asked = number(item)
        if asked is None or key in HUMAN:
            continue
        most = number(granted.get(key))
        if most is None:
            yield Denied("physical", key, "the policy sets no limit", "unknown")
        elif asked > most:
            yield Denied("physical", key, f"up to {asked:g}, the policy allows {most:g}")


def network(module: View, policy: Policy) -> Iterator[Denied]:
    """Hosts and services that may not be reached."""
    if module.network is True:
        wanted: tuple[str, ...] = ("network",)
    else:
        wanted = module.network or ()
    if not wanted or policy.network is True:
        return
    if policy.network is None:
        yield Denied("network", wanted[0], "the policy does not say", "unknown")
        return
    allowed = policy.network or ()
    yield from (Denied("network", host, "the policy forbids it") for host in wanted if host not in allowed)


def data(module: View, policy: Policy) -> Iterator[Denied]:
    """Data that may not be read or written."""
    return _listed("data", module.data or (), policy.data)


def operational(module: View, policy: Policy) -> Iterator[Denied]:
    """Operational permissions that are not granted."""
    return _listed("operational", module.operational or (), policy.operational)


def audit(module: View, policy: Policy) -> Iterator[Denied]:
    """An audit that is stronger than what is offered."""
    if module.audit is None or module.audit == "none":
        return
    if policy.audit is None or module.audit not in AUDIT_LEVELS or policy.audit not in AUDIT_LEVELS:
        yield Denied("audit", module.audit, "the policy does not say", "unknown")
    elif AUDIT_LEVELS.index(module.audit) > AUDIT_LEVELS.index(policy.audit):
        yield Denied("audit", module.audit, f"the policy offers {policy.audit}")


def asked(module: View) -> dict[tuple[str, str], Any]:
    """All permissions that a module asks for, by kind and name, with the amount asked for."""
    found: dict[tuple[str, str], Any] = {("physical", key): item for key, item in _physical(module).items()}
    for name in module.data or ():
        found["data", name] = True
    for name in module.operational or ():
        found["operational", name] = True
    if module.network is True:
        found["network", "network"] = True
    elif module.network:
        found.update({("network", host): True for host in module.network})
    return found


def _physical(module: View) -> dict[str, Any]:
    return {key: item for key, item in (module.physical or {}).items() if item is not False}


def _not_granted(wanted: Mapping[str, Any], policy: Policy) -> Iterator[Denied]:
    granted = policy.physical
    for key in wanted:
        if granted is None:
            yield Denied("physical", key, "the policy does not say", "unknown")
        elif not granted.get(key):
            yield Denied("physical", key, "the policy does not grant it")


def _listed(kind: str, wanted: tuple[str, ...], granted: tuple[str, ...] | None) -> Iterator[Denied]:
    for name in wanted:
        if granted is None:
            yield Denied(kind, name, "the policy does not say", "unknown")
        elif name not in granted and f"{name.partition(':')[0]}:*" not in granted:
            yield Denied(kind, name, "the policy does not grant it")


# An audit that is not declared asks for none; nearness and limits are undeclared together with the scopes.
_DECIDED: Final = frozenset({"physical", "network", "data", "operational"})
_PART_OF_A_FIELD: Final = (contact, limits)
