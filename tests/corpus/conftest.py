"""Blind runs that many tests ask: a run starts processes, so it is made once."""

from __future__ import annotations

import pytest
from corpus_repos import driver, make_clone, reader, renamed_topic
from ecm_corpus.blind import Run, run_blind
from ecm_corpus.interface import Composition, InterfaceCase, Source
from judged_cases import Judged


@pytest.fixture(scope="session")
def judged(tmp_path_factory: pytest.TempPathFactory) -> Judged:
    """The renamed topic, and a case that has nothing to do with it; nobody writes into their clones."""
    clones = tmp_path_factory.mktemp("clones")
    small = renamed_topic(clones)
    make_clone(clones, ("1.0.0", {**driver("odom", "1.0.0"), **reader("odom")}), repository="other/base")
    other = InterfaceCase("R-other", "robust", {"a": Composition((Source("other/base", "1.0.0"),))})
    return Judged(clones, small, other, run_blind([small, other], Run(clones)))
