"""Stored results judged again by the pinned checker of today: no clone is needed, and nothing is read anew.

What other engines found, and the sources that were read, stay those of the run.
"""

from __future__ import annotations

from pathlib import Path

import msgspec
from ecm_checker.freeze import content_hash
from ecm_checker.hub.package import Package

from ecm_corpus.chain import chained
from ecm_corpus.documents import stored, unpacked
from ecm_corpus.results import CaseResult, Results, StateResult
from ecm_corpus.verdict import check_findings


def judged_again(results: Results, store: Path) -> Results:
    """Results with the findings of the checker of today, and their chain.

    Raises:
        InputError: a document that they name is not in the store.
    """
    checker = content_hash()
    cases = [_case(case, store) for case in results.cases]
    return msgspec.structs.replace(results, checker=checker, cases=tuple(chained(cases, results.extractor, checker)))


def sides_of(state: StateResult, store: Path) -> dict[str, list[Package]]:
    """The documents of a state by side.

    Raises:
        InputError: one is not in the store.
    """
    sides: dict[str, list[Package]] = {}
    for name, mark in sorted(state.documents.items()):
        sides.setdefault(name.partition("/")[0], []).extend(unpacked(stored(mark, store)))
    return sides


def _case(case: CaseResult, store: Path) -> CaseResult:
    return msgspec.structs.replace(case, states={name: _state(state, store) for name, state in case.states.items()})


def _state(state: StateResult, store: Path) -> StateResult:
    found = check_findings(sides_of(state, store))
    return msgspec.structs.replace(state, findings={**state.findings, "check": found})
