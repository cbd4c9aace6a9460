"""Blind runs: the interface parts of cases in, results with their chain of hashes and the store of documents out."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version
from pathlib import Path

import msgspec
from ecm_checker.freeze import content_hash

from ecm_corpus.blind_child import Answer, Order
from ecm_corpus.chain import chained, digest_of, extractor_hash
from ecm_corpus.clones import missing_from
from ecm_corpus.documents import STORE, keep, kept
from ecm_corpus.interface import InterfaceCase
from ecm_corpus.results import SCHEMA, CaseResult, Results
from ecm_extract.errors import InputError, ToolError


class Run(msgspec.Struct, frozen=True):
    """How cases are run.

    Attributes:
        clones: folder with local clones. cache: take what was parsed before from the cache.
        jobs: cases at a time. progress: called with the id of each case that is done.
    """

    clones: Path
    cache: bool = True
    jobs: int = os.cpu_count() or 1
    progress: Callable[[str], None] = lambda _: None


class Outcome(msgspec.Struct, frozen=True):
    """Results of a run, and the files of the store that they name."""

    results: Results
    files: dict[str, bytes]


def run_blind(cases: Sequence[InterfaceCase], run: Run) -> Outcome:
    """Judge cases, each in a process of its own that cannot open a narrative.

    A case whose repositories are not there is in the results with what is missing.

    Raises:
        InputError: a case cannot be judged. ToolError: its process failed.
    """
    ordered = sorted(cases, key=lambda case: case.case)
    with ThreadPoolExecutor(run.jobs) as pool:
        answered = list(pool.map(lambda case: _judged(case, run), ordered))
    files = {name: data for _, answer in answered for name, data in answer.files.items()}
    extractor, checker = extractor_hash(), content_hash()
    results = Results(
        schema=SCHEMA,
        version=version("ecm-extract"),
        extractor=extractor,
        checker=checker,
        cases=tuple(chained([result for result, _ in answered], extractor, checker)),
    )
    return Outcome(results, files)


def write_outcome(outcome: Outcome, folder: Path) -> None:
    """Write `results.json` and the store `documents/`; files of the store that no result names are removed."""
    store = folder / STORE
    store.mkdir(parents=True, exist_ok=True)
    for name, data in outcome.files.items():
        keep(name, data, store)
    for name, file in kept(store).items():
        if name not in outcome.files:
            file.unlink()
    (folder / "results.json").write_bytes(results_document(outcome.results))


def results_document(results: Results) -> bytes:
    """The results as JSON that a person can read, keys sorted."""
    return msgspec.json.format(msgspec.json.encode(results, order="sorted"), indent=1) + b"\n"


def _judged(case: InterfaceCase, run: Run) -> tuple[CaseResult, Answer]:
    missing = missing_from(case.states, run.clones)
    answer = Answer() if missing else _asked(Order(case, str(run.clones.resolve()), run.cache))
    if answer.wrong:
        message = f"{case.case}: {answer.wrong}"
        raise InputError(message)
    run.progress(case.case)
    result = CaseResult(
        case=case.case,
        substrate=case.substrate,
        input=digest_of(case),
        output="",
        previous="",
        hash="",
        missing=missing,
        states=answer.states,
    )
    return result, answer


def _asked(order: Order) -> Answer:
    """Ask a new process that starts in an empty folder and is given no path but that of the clones."""
    with tempfile.TemporaryDirectory() as empty:
        done = subprocess.run(
            [sys.executable, "-m", "ecm_corpus.blind_child"],
            input=msgspec.msgpack.encode(order),
            capture_output=True,
            cwd=empty,
            check=False,
        )
    if done.returncode != 0:
        last = done.stderr.decode("utf-8", "replace").strip().rpartition("\n")[2]
        message = f"{order.case.case}: the blind run stopped: {last}"
        raise ToolError(message)
    return msgspec.msgpack.decode(done.stdout, type=Answer)
