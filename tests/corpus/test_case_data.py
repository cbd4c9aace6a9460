"""The cases themselves: both parts of each, that they fit together, and that the blind part tells nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from ecm_corpus.interface import InterfaceCase, Source, read_interface, read_record, sources_of
from ecm_corpus.narrative import ExcludedList, Narrative, read_narrative

CASES = Path(__file__).resolve().parents[2] / "corpus" / "cases"
IDS = sorted(path.stem for path in (CASES / "interface").glob("*.yaml"))
INTERFACES = {case: read_interface(CASES / "interface" / f"{case}.yaml") for case in IDS}
NARRATIVES = {case: read_narrative(CASES / "narrative" / f"{case}.yaml") for case in IDS}
PARTS = [(INTERFACES[case], NARRATIVES[case]) for case in IDS]

COMMIT = re.compile(r"[0-9a-f]{40}")
TAG = re.compile(r"v?\d+(\.\d+)+")
FACT = re.compile(r"(?P<repository>[\w-]+/[\w.-]+)@(?P<ref>[\w.-]+):(?P<path>[^:\s]+):(?P<line>[1-9]\d*)")

KEYS = {
    "case",
    "substrate",
    "states",
    "question",
    "trees",
    "launch",
    "old",
    "new",
    "consumers",
    "repository",
    "ref",
    "packages",
}


def sources(case: InterfaceCase) -> Iterator[Source]:
    for state in case.states.values():
        yield from sources_of(state)


def keys_of(value: Any) -> Iterator[str]:
    """Every key of a document, the names of states aside."""
    if isinstance(value, dict):
        for key, below in value.items():
            if len(key) > 1:
                yield key
            yield from keys_of(below)
    elif isinstance(value, list):
        for below in value:
            yield from keys_of(below)


def named(parts: tuple[InterfaceCase, Narrative]) -> str:
    return parts[0].case


def test_every_case_has_both_parts() -> None:
    assert sorted(path.stem for path in (CASES / "narrative").glob("*.yaml")) == IDS


@pytest.mark.parametrize("parts", PARTS, ids=named)
def test_both_parts_are_of_the_same_case(parts: tuple[InterfaceCase, Narrative]) -> None:
    interface, narrative = parts
    assert interface.case == narrative.case
    assert INTERFACES[interface.case] is interface
    prefix = {"R": "robust", "B": "ros2", "REP": "replication"}.get(interface.case.partition("-")[0])
    assert prefix in (None, interface.substrate)


@pytest.mark.parametrize("parts", PARTS, ids=named)
def test_the_narrative_names_states_of_the_interface(parts: tuple[InterfaceCase, Narrative]) -> None:
    interface, narrative = parts
    assert {*narrative.buggy, *narrative.controls} <= set(interface.states)
    assert not {*narrative.buggy} & {*narrative.controls}
    assert bool(narrative.buggy) == (narrative.limit != "not_scorable")
    assert bool(interface.states) == (narrative.limit != "not_scorable")


@pytest.mark.parametrize("parts", PARTS, ids=named)
def test_a_case_that_is_judged_says_what_a_finding_must_be_about(parts: tuple[InterfaceCase, Narrative]) -> None:
    _, narrative = parts
    if narrative.buggy:
        assert narrative.conflict.files
        assert narrative.conflict.names
    if narrative.limit != "none":
        assert narrative.audit


@pytest.mark.parametrize("case", INTERFACES.values(), ids=IDS)
def test_refs_stay_what_they_are(case: InterfaceCase) -> None:
    """A branch or a short id can come to mean another commit."""
    for source in sources(case):
        assert COMMIT.fullmatch(source.ref) or TAG.fullmatch(source.ref), source
        assert re.fullmatch(r"[\w-]+/[\w.-]+", source.repository)


@pytest.mark.parametrize("case", INTERFACES.values(), ids=IDS)
def test_the_names_of_states_say_nothing(case: InterfaceCase) -> None:
    assert list(case.states) == list("abcdefghijklmnop"[: len(case.states)])


@pytest.mark.parametrize("case", IDS)
def test_the_blind_part_has_no_key_of_the_story(case: str) -> None:
    text = (CASES / "interface" / f"{case}.yaml").read_text()
    assert set(keys_of(yaml.safe_load(text))) <= KEYS
    assert "#" not in text


@pytest.mark.parametrize("narrative", NARRATIVES.values(), ids=IDS)
def test_facts_can_be_looked_up(narrative: Narrative) -> None:
    repositories = {source.repository for source in sources(INTERFACES[narrative.case])}
    for fact in narrative.facts:
        found = FACT.fullmatch(fact.at)
        assert found is not None, fact.at
        assert COMMIT.fullmatch(found["ref"]) or TAG.fullmatch(found["ref"]), fact.at
        assert fact.shows
    if narrative.buggy:
        assert any(fact.at.partition("@")[0] in repositories for fact in narrative.facts)


def test_the_buggy_states_are_not_always_at_the_same_place() -> None:
    several = [parts for parts in PARTS if len(parts[0].states) > 1]
    first = sum("a" in narrative.buggy for _, narrative in several)
    assert len(several) // 5 <= first <= len(several) - len(several) // 5


def of(substrate: str) -> list[Narrative]:
    return [narrative for interface, narrative in PARTS if interface.substrate == substrate]


@pytest.mark.parametrize(("substrate", "cases", "fired"), [("robust", 32, 10), ("ros2", 16, 10), ("replication", 4, 4)])
def test_the_ledger_is_complete(substrate: str, cases: int, fired: int) -> None:
    """The paper's table of recall: every scored bug is here, with what its checker said of it."""
    found = of(substrate)
    assert len(found) == cases
    assert sum(bool(set(narrative.paper_fired or ()) & set(narrative.gold)) for narrative in found) == fired


@pytest.mark.parametrize(
    ("substrate", "dimension", "hits", "total"),
    [
        ("robust", "signature", 4, 14),
        ("robust", "behavior", 0, 8),
        ("robust", "resources", 0, 0),
        ("robust", "recovery", 0, 0),
        ("robust", "versioning", 6, 18),
        ("ros2", "signature", 0, 5),
        ("ros2", "behavior", 3, 6),
        ("ros2", "resources", 2, 4),
        ("ros2", "recovery", 0, 2),
        ("ros2", "versioning", 5, 7),
        ("replication", "signature", 1, 1),
        ("replication", "versioning", 3, 3),
    ],
)
def test_each_dimension_has_the_paper_s_count(substrate: str, dimension: str, hits: int, total: int) -> None:
    """The paper's table per dimension; a bug of two dimensions counts under each."""
    gold = [narrative for narrative in of(substrate) if dimension in narrative.gold]
    assert len(gold) == total
    assert sum(dimension in (narrative.paper_fired or ()) for narrative in gold) == hits


def test_the_excluded_bugs_are_not_in_the_ledger() -> None:
    excluded = read_record(CASES / "excluded.yaml", ExcludedList).excluded
    names = [each.case for each in excluded]
    assert len(set(names)) == len(names)
    ledger = {interface.case for interface, _ in PARTS if interface.substrate != "wider"}
    assert not ledger & set(names)
    assert sum(name.startswith("R-") for name in names) == 221 - 32 - 29
    assert all(each.source and each.reason for each in excluded)
