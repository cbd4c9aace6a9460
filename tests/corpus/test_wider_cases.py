"""The wider cases: further documented bugs that sources can show, in the form of the others."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from ecm_corpus.interface import read_interface, sources_of
from ecm_corpus.narrative import read_narrative

CASES = Path(__file__).parents[2] / "corpus" / "cases"
WIDER = sorted(path.stem for path in (CASES / "interface").glob("W-*.yaml"))


def test_there_are_29() -> None:
    """ROBUST bugs outside the ledger that the triage calls static: 23 of an interface, 6 of a launch."""
    assert len(WIDER) == 29


@pytest.mark.parametrize("case", WIDER)
def test_both_parts_fit(case: str) -> None:
    interface = read_interface(CASES / "interface" / f"{case}.yaml")
    told = read_narrative(CASES / "narrative" / f"{case}.yaml")
    assert (interface.case, told.case, interface.substrate) == (case, case, "wider")
    assert {*told.buggy, *told.controls} == interface.states.keys()
    assert not {*told.buggy} & {*told.controls}
    assert told.paper_fired is None
    assert told.gold
    assert told.conflict.files
    assert told.conflict.names


@pytest.mark.parametrize("case", WIDER)
def test_refs_are_commits(case: str) -> None:
    """A tag may move."""
    for state in read_interface(CASES / "interface" / f"{case}.yaml").states.values():
        assert all(re.fullmatch(r"[0-9a-f]{40}", source.ref) for source in sources_of(state))


def test_which_letter_is_broken_varies() -> None:
    """The order of the states tells nothing."""
    broken = [read_narrative(CASES / "narrative" / f"{case}.yaml").buggy[0] for case in WIDER]
    assert 8 <= broken.count("a") <= 21


@pytest.mark.parametrize("case", WIDER)
def test_the_facts_show_the_broken_state(case: str) -> None:
    """Not only its repair, and no line twice."""
    interface = read_interface(CASES / "interface" / f"{case}.yaml")
    told = read_narrative(CASES / "narrative" / f"{case}.yaml")
    repaired = {source.ref for name in told.controls for source in sources_of(interface.states[name])}
    broken = {source.ref for name in told.buggy for source in sources_of(interface.states[name])} - repaired
    assert broken & {fact.at.partition("@")[2].partition(":")[0] for fact in told.facts}
    assert len({fact.at for fact in told.facts}) == len(told.facts)
