"""Simpler checkers over the same contracts, to compare with: what would they have said?"""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.case import Case
from ecm_checker.catalogue import catalogue
from ecm_checker.operations.engine import Subject, findings, ready
from ecm_checker.outcome import Outcome, decide
from ecm_checker.profiles import NO_PROFILES, Profiles
from ecm_checker.rule import Entry, Tier
from ecm_checker.versions import bump_between


def schema_only(modules: Iterable[Subject], *, ordered: bool = True) -> Outcome:
    """Types of topics, services, actions and fields; nothing else."""
    return decide(findings(_case(modules, ordered), _of("schema")))


def schema_and_qos(modules: Iterable[Subject], *, ordered: bool = True) -> Outcome:
    """Like `schema_only`, and request and offer of DDS policies."""
    return decide(findings(_case(modules, ordered), _of("schema", "qos")))


def semver_only(old: Subject, new: Subject, profiles: Profiles = NO_PROFILES) -> Outcome:
    """Dependency ranges and the version number: a step that is not major is compatible."""
    before, after = ready(old), ready(new)
    step = bump_between(before.contract.ecm.version, after.contract.ecm.version)
    found = findings(Case((after,), profiles, previous=before), _of("semver"))
    if step is None:
        return "review"
    return "reject" if step == "major" else decide(found)


def schema_only_upgrade(old: Subject, new: Subject, dependents: Iterable[Subject] | None = None) -> Outcome:
    """What the signature lost, and nothing else."""
    users = None if dependents is None else tuple(map(ready, dependents))
    case = Case((ready(new),), previous=ready(old), dependents=users)
    return decide(findings(case, _of("schema")))


def _case(modules: Iterable[Subject], ordered: bool) -> Case:
    return Case(tuple(map(ready, modules)), ordered=ordered)


def _of(*tiers: Tier) -> tuple[Entry, ...]:
    return tuple(entry for entry in catalogue() if entry.rule.tier in tiers)
