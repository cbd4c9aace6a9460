"""The results under version control: unbroken, made from these cases, and repeated by the checker of today."""

from __future__ import annotations

from pathlib import Path

import pytest
from ecm_corpus.again import sides_of
from ecm_corpus.chain import broken_links
from ecm_corpus.documents import kept
from ecm_corpus.folder import interfaces, narratives, read_results
from ecm_corpus.results import CaseResult
from ecm_corpus.verdict import check_findings

CORPUS = Path(__file__).parents[2] / "corpus"
RESULTS = read_results(CORPUS / "results.json")


def test_the_chain_holds() -> None:
    """Nobody changed a case or a result after the run."""
    assert broken_links(RESULTS, interfaces(CORPUS)) == ()


def test_every_case_was_judged_and_has_its_story() -> None:
    assert [case.case for case in RESULTS.cases] == [case.case for case in interfaces(CORPUS)]
    assert {case.case for case in RESULTS.cases} == narratives(CORPUS).keys()
    assert not [case.case for case in RESULTS.cases if case.missing]


def test_the_store_holds_what_the_results_name() -> None:
    named = {mark for case in RESULTS.cases for state in case.states.values() for mark in state.documents.values()}
    assert kept(CORPUS / "documents").keys() == named


@pytest.mark.parametrize("case", RESULTS.cases, ids=lambda case: case.case)
def test_the_checker_says_the_same_today(case: CaseResult) -> None:
    """What was decided from the stored contracts is decided again, to the last finding."""
    for state in case.states.values():
        assert check_findings(sides_of(state, CORPUS / "documents")) == state.findings["check"]
