"""What evidence proves: every way in which it could prove too much."""

from __future__ import annotations

import itertools
from datetime import UTC, datetime, timedelta
from typing import Any

import msgspec
import pytest
from ecm_checker.wire import EvidenceRecord, EvidenceSubject, Witness
from sample import published
from scenario import contract, package
from sqlalchemy import func, select

from ecm_extract.errors import InputError
from ecm_extract.registry import clock
from ecm_extract.registry.evidence import Kept, add_evidence, evidence_of
from ecm_extract.registry.proof import Proof, proof_of
from ecm_extract.registry.releases import find_release
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import EvidenceRow

CONTENTS = {None: "sha256:all", "a": "sha256:a", "b": "sha256:b"}
_NUMBERS = itertools.count()


def record(result: Any, module: str | None = None, by: str = "Ada", **rest: Any) -> EvidenceRecord:
    """A record that names the content of its subject unless it is told otherwise."""
    subject = EvidenceSubject("driver", "1.0.0", module, rest.pop("contract", CONTENTS.get(module)))
    begun = clock.written(datetime(2026, 1, 1, tzinfo=UTC) + timedelta(seconds=next(_NUMBERS)))
    fields = {"kind": "upgrade_test", "begun": begun, **rest}
    return EvidenceRecord(schema="ecm-extract/evidence/1", subject=subject, result=result, by=Witness(by), **fields)


def proof(*records: EvidenceRecord) -> Proof:
    """What records prove of two modules that run, in the order of their times."""
    kept = [Kept(str(number), each) for number, each in enumerate(records)]
    return proof_of(sorted(kept, key=lambda each: each.time), CONTENTS, {"a", "b"})


HOLDING = [
    pytest.param([record("confirmed")], id="the package as a whole"),
    pytest.param([record("confirmed", "a"), record("confirmed", "b", by="Grace")], id="each module that runs"),
    pytest.param([record("contradicted"), record("confirmed")], id="taken back by the witness"),
    pytest.param([record("confirmed", promised=4, seen=1)], id="seen in a recording of one topic"),
    pytest.param([record("confirmed"), record("not_seen", "a")], id="seen once, not seen later"),
    pytest.param([record("contradicted", by="robot 7"), record("confirmed", by=" Robot  7")], id="one name, two ways"),
]
NOT_HOLDING = [
    pytest.param([], id="nothing"),
    pytest.param([record("confirmed", "a")], id="a module was not tested"),
    pytest.param([record("confirmed", "a"), record("not_seen", "b")], id="a module was not seen"),
    pytest.param([record("confirmed", "a"), record("doubtful", "b")], id="a module is in doubt"),
    pytest.param([record("contradicted", "a"), record("confirmed", "b")], id="of two modules one is contradicted"),
    pytest.param([record("contradicted"), record("not_seen")], id="not seen takes no contradiction back"),
    pytest.param([record("contradicted"), record("doubtful")], id="a doubt takes no contradiction back"),
    pytest.param([record("confirmed"), record("doubtful")], id="a doubt takes a confirmation back"),
    pytest.param([record("contradicted"), record("confirmed", by="Grace")], id="somebody else cannot take it back"),
    pytest.param([record("contradicted", "a"), record("confirmed")], id="the whole does not speak of its module"),
    pytest.param([record("confirmed", contract="sha256:other")], id="another content"),
    pytest.param([record("confirmed", contract=None)], id="no content"),
    pytest.param([record("confirmed", promised=4, seen=0)], id="none of its endpoints was seen"),
    pytest.param([record("confirmed", promised=0, seen=0)], id="there was nothing to compare"),
    pytest.param([record("confirmed", "c", contract="sha256:all")], id="a module that it does not have"),
    pytest.param([record("confirmed", "a", contract="sha256:b")], id="the content of another module"),
]


@pytest.mark.parametrize("records", HOLDING)
def test_proved(records: list[EvidenceRecord]) -> None:
    """All that runs is confirmed, and nobody contradicts."""
    assert proof(*records).holds


@pytest.mark.parametrize("records", NOT_HOLDING)
def test_not_proved(records: list[EvidenceRecord]) -> None:
    """Whatever is wanting, the gate stays closed."""
    assert not proof(*records).holds


@pytest.mark.parametrize("results", [("confirmed", "contradicted"), ("contradicted", "confirmed")])
def test_of_one_moment_the_worse_counts(small: Registry, results: tuple[str, str]) -> None:
    """One recording that is looked at twice begins at one time."""
    published(small, (package("1.0.0", contract()),))
    with small.writing() as session:
        release = find_release(session, "delivery@1.0.0")
        subject = EvidenceSubject("delivery", "1.0.0", None, f"sha256:{release.digest}")
        said = [record(each, begun="2026-01-01T00:00:00Z", note=each) for each in results]
        add_evidence(session, [msgspec.structs.replace(each, subject=subject) for each in said])
        found = evidence_of(session, release.id)
    assert [each.evidence.result for each in found] == ["confirmed", "contradicted"]


UNSOUND = [
    pytest.param({"begun": "2999-01-01T00:00:00Z"}, "is to come", id="of the future: it would stay the newest"),
    pytest.param({"by": Witness("  ")}, "who saw it", id="of nobody"),
    pytest.param({"subject": EvidenceSubject("delivery", None)}, "without a version", id="of no release"),
    pytest.param({"subject": EvidenceSubject("delivery", "9.9.9")}, "not in the registry", id="of another release"),
]


@pytest.mark.parametrize(("change", "told"), UNSOUND)
def test_unsound_records_are_refused(small: Registry, change: dict[str, Any], told: str) -> None:
    """None of the records that come with it is kept either."""
    published(small, (package("1.0.0", contract()),))
    good = msgspec.structs.replace(record("confirmed"), subject=EvidenceSubject("delivery", "1.0.0"))
    with pytest.raises(InputError, match=told), small.writing() as session:
        add_evidence(session, [good, msgspec.structs.replace(good, **change)])
    with small.reading() as session:
        assert session.scalar(select(func.count()).select_from(EvidenceRow)) == 0
