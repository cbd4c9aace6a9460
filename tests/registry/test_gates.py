"""Each cell of the paper's tables of channels and classes, as what a gate lets pass and what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
import pytest
from bench import ALL, PANEL, POLICY, ROBOT, TOPIC, Bench
from ecm_checker.contract import Contract
from ecm_checker.fields import missing_fields, required_fields
from ecm_checker.hub.package import Package
from ecm_checker.profiles import Embodiment, Policy, Profiles
from ecm_checker.release import ACTIONS, CLASSES
from sample import published
from scenario import MODULE, contract, package
from sqlalchemy.orm import Session

from ecm_extract.diff.migration import migration_of
from ecm_extract.registry import clock
from ecm_extract.registry.channels import gate_table
from ecm_extract.registry.gates import Verdict, Waiver, judge
from ecm_extract.registry.matter import Inputs
from ecm_extract.registry.releases import find_release
from ecm_extract.registry.store import Registry

CHANNELS = ("sandbox", "beta", "stable", "certified")
PAPER = {
    "contract": ("partial", "complete", "complete", "complete"),
    "compatibility": ("optional", "limited", "verified", "verified"),
    "policy": ("optional", "limited", "reviewed", "strong"),
    "upgrade": ("optional", "limited", "tested", "tested"),
    "rollback": ("optional", "recommended", "required", "required_traced"),
}


def test_the_table_is_that_of_the_paper() -> None:
    """Twenty cells."""
    table = gate_table()
    assert tuple(table.channels) == CHANNELS
    for column, levels in PAPER.items():
        assert tuple(table.channels[name][column] for name in CHANNELS) == levels


def _same() -> Package:
    return package("1.0.1", contract(), provides=(TOPIC,))


def _ready(registry: Registry, new: Package) -> Bench:
    bench = Bench(registry, new)
    bench.show(*ALL)
    bench.show("policy_review", by="Grace")
    return bench


def _migrated(registry: Registry, new: Package) -> Bench:
    bench = _ready(registry, new)
    bench.migration = migration_of("1.0.0", "2.0.0", bench.impact().changes)
    return bench


def _complete(registry: Registry) -> Bench:
    return _ready(registry, _same())


def _incomplete(registry: Registry) -> Bench:
    return _ready(registry, package("1.0.1", contract(signature__timeout_ms=None), provides=(TOPIC,)))


def _unmigrated(registry: Registry) -> Bench:
    return _ready(registry, package("2.0.0", contract()))


def _breaking_others(registry: Registry) -> Bench:
    return _migrated(registry, package("2.0.0", contract()))


def _small_step(registry: Registry) -> Bench:
    return _migrated(registry, package("1.0.1", contract()))


def _new_permission(registry: Registry) -> Bench:
    asked = contract(permissions__physical={"motion": True, "human_contact": True})
    bench = Bench(registry, package("2.0.0", asked, provides=(TOPIC,)))
    bench.show("validation", "upgrade_test", "rollback_test")
    return bench


def _unreviewed(registry: Registry) -> Bench:
    bench = Bench(registry, _same())
    bench.show("validation", "upgrade_test", "rollback_test")
    return bench


def _one_reviewer(registry: Registry) -> Bench:
    bench = Bench(registry, _same())
    bench.show(*ALL)
    return bench


def _more_resources(registry: Registry) -> Bench:
    needs = contract(resources__compute={"cpu_cores": 2, "gpu": True})
    bench = Bench(registry, package("2.0.0", needs, provides=(TOPIC,)))
    bench.show("upgrade_test", "policy_review", "rollback_test")
    bench.show("policy_review", by="Grace")
    return bench


def _other_recovery(registry: Registry) -> Bench:
    other = contract(recovery__retry={"max": 1, "strategy": "explore"})
    bench = Bench(registry, package("2.0.0", other, provides=(TOPIC,)))
    bench.show("upgrade_test", "policy_review", "rollback_test")
    bench.show("policy_review", by="Grace")
    return bench


def _untested(registry: Registry) -> Bench:
    bench = Bench(registry, _same())
    bench.show("validation", "policy_review", "rollback_test")
    bench.show("policy_review", by="Grace")
    return bench


def _no_way_back(registry: Registry) -> Bench:
    bench = Bench(registry, _same())
    bench.show("validation", "policy_review", "upgrade_test")
    bench.show("policy_review", by="Grace")
    return bench


def _untraced(registry: Registry) -> Bench:
    bench = _no_way_back(registry)
    bench.show("rollback_test", on=None)
    return bench


# What is wrong, the gate that it concerns, and from which channel on it is refused: one row for each level.
CELLS = [
    (_complete, "contract", None),
    (_incomplete, "contract", "beta"),
    (_unmigrated, "compatibility", "beta"),
    (_small_step, "compatibility", "beta"),
    (_breaking_others, "compatibility", "stable"),
    (_new_permission, "policy", "beta"),
    (_unreviewed, "policy", "stable"),
    (_one_reviewer, "policy", "certified"),
    (_more_resources, "resource", "beta"),
    (_other_recovery, "recovery", "beta"),
    (_untested, "resource", "stable"),
    (_untested, "recovery", "stable"),
    (_no_way_back, "rollback", "stable"),
    (_untraced, "rollback", "certified"),
]


@pytest.mark.parametrize(("make", "gate", "first"), CELLS)
def test_a_cell(small: Registry, make: Callable[[Registry], Bench], gate: str, first: str | None) -> None:
    """Each level lets pass what the one below demands, and refuses what it does not."""
    bench = make(small)
    limit = CHANNELS.index(first) if first else len(CHANNELS)
    for number, channel in enumerate(CHANNELS):
        assert (gate in bench.refused(channel)) == (number >= limit), channel


def test_a_good_release_goes_all_the_way(small: Registry) -> None:
    """No gate refuses what shows all."""
    bench = _complete(small)
    assert [bench.refused(channel) for channel in CHANNELS] == [set()] * 4


CLASSES_OF_THE_PAPER = [
    pytest.param({}, "fully-compatible", "promote", id="nothing"),
    pytest.param({"resources__compute": {"cpu_cores": 4}}, "resource-sensitive", "revalidate", id="resources"),
    pytest.param(
        {"permissions__physical": {"motion": True, "human_contact": True}},
        "policy-sensitive",
        "governance_review",
        id="permissions",
    ),
    pytest.param(
        {
            "permissions__physical": {"motion": True, "human_contact": True},
            "resources__compute": {"cpu_cores": 4},
        },
        "policy-sensitive",
        "governance_review",
        id="permissions, resources too",
    ),
    pytest.param(
        {"permissions__physical": {"motion": True, "human_contact": True}, "signature__timeout_ms": 9000},
        "policy-sensitive",
        "governance_review",
        id="permissions, a signature that still fits",
    ),
    pytest.param({"recovery__rollback_state": "home"}, "recovery-sensitive", "revalidate", id="recovery"),
    pytest.param(
        {"recovery__rollback_state": "home", "resources__compute": {"cpu_cores": 4}},
        "recovery-sensitive",
        "revalidate",
        id="recovery, resources too",
    ),
    pytest.param({"behavior__preconditions": ["arm.is_homed"]}, "breaking", "migration", id="behavior"),
    pytest.param(
        {"behavior__preconditions": ["arm.is_homed"], "permissions__physical": {"zone": True}},
        "breaking",
        "migration",
        id="behavior, permissions too",
    ),
]


@pytest.mark.parametrize(("fields", "name", "action"), CLASSES_OF_THE_PAPER)
def test_a_class(small: Registry, fields: dict[str, Any], name: str, action: str) -> None:
    """What changed decides the class, and the class what is asked for."""
    verdict = Bench(small, package("2.0.0", contract(**fields), provides=(TOPIC,))).judge("beta")
    assert (verdict.compatibility_class, verdict.action) == (name, action)


def test_a_signature_that_changed_is_breaking(small: Registry) -> None:
    """The first column of the table of classes."""
    verdict = Bench(small, package("2.0.0", contract())).judge("beta")
    assert (verdict.compatibility_class, verdict.action) == ("breaking", "migration")
    assert set(ACTIONS) == set(CLASSES)


def test_a_waiver_counts_until_its_end(small: Registry) -> None:
    """It names who answers, and it is in the verdict."""
    bench = _incomplete(small)
    named = Waiver("contract", "Ada", "a demonstration", "2999-01-01T00:00:00.000000Z")
    ended = Waiver("contract", "Ada", "a demonstration", "2001-01-01T00:00:00.000000Z")
    verdict = bench.judge("beta", [named])
    assert verdict.passed
    assert [each.waiver for each in verdict.gates if each.state == "waived"] == [named]
    assert bench.refused("beta", waivers=[ended]) == {"contract"}


def test_the_newest_evidence_counts(small: Registry) -> None:
    """What was confirmed and then contradicted is not confirmed."""
    bench = _complete(small)
    bench.show("rollback_test", result="contradicted")
    assert "rollback" in bench.refused("stable")
    bench.show("observation", result="contradicted")
    assert "contract" in bench.refused("beta")


def test_profiles_are_asked(small: Registry) -> None:
    """A robot that lacks what the release needs, a policy that forbids it, no policy at all."""
    bench = _complete(small)
    bare = Embodiment(sensors=(), actuators=(), compute={"cpu_cores": 1, "gpu": False})
    strict = Policy(physical={"motion": False}, data=(), network=False, operational=(), audit="full")
    assert "resource" in bench.refused("stable", profiles=Profiles(bare, POLICY))
    assert "policy" in bench.refused("stable", profiles=Profiles(ROBOT, strict))
    assert "policy" not in bench.refused("stable", profiles=Profiles())
    assert "policy" in bench.refused("certified", profiles=Profiles())


def test_what_does_not_run_needs_fewer_fields(small: Registry) -> None:
    """An interface package has nothing to say of retry and frames."""
    found = contract()
    identity = msgspec.structs.replace(found.ecm, kind="interface")
    bare = Contract(identity, versioning=found.versioning)
    assert identity.module_id == MODULE
    bench = Bench(small, package("1.0.1", bare, provides=(TOPIC,)))
    assert "contract" not in bench.refused("beta")


def _of_kind(kind: str, lacking: str | None = None) -> Contract:
    """A complete contract of a module of a kind, without one field."""
    found = contract(**({lacking.replace(".", "__"): None} if lacking else {}))
    identity = msgspec.structs.replace(found.ecm, kind=kind)
    whole = msgspec.structs.replace(found, ecm=identity)
    return msgspec.structs.replace(whole, missing=missing_fields(whole))


KINDS = ("node", "component", "controller", "plugin", "interface", "library", "launch")
FIELDS = [path for path in required_fields("node") if not path.startswith("ecm.")]


@pytest.mark.parametrize("kind", KINDS)
def test_each_field_of_a_kind_is_asked_for(small: Registry, kind: str) -> None:
    """The rows of the paper's schema that are marked Y, by kind of module: without any of them no channel above."""
    published(small, (package("1.0.0", _of_kind(kind), provides=(TOPIC,)), PANEL))
    refused = []
    for number, path in enumerate(FIELDS):
        published(small, (package(f"1.0.{number + 1}", _of_kind(kind, path), provides=(TOPIC,)),))
        with small.reading() as session:
            verdict = _judged(session, f"delivery@1.0.{number + 1}")
        gate = next(each for each in verdict.gates if each.gate == "contract")
        assert gate.state == ("refused" if path in required_fields(kind) else "passed"), path
        refused += [path] if path in str(gate.reasons) else []
    assert refused == [path for path in FIELDS if path in required_fields(kind)]


def _judged(session: Session, name: str) -> Verdict:
    release, old = find_release(session, name), find_release(session, "delivery@1.0.0")
    inputs = Inputs(
        release=release.id, digest=release.digest, previous=old.id, source="sandbox", channel="beta",
        since=release.stored, scope=(), target=old.id, evidence=(), migration=None, embodiment=None, policy=None,
        at=clock.written(clock.now()),
    )  # fmt: skip
    return judge(session, inputs, (), gate_table())
