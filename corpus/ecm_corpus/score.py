"""The tables of the evaluation: strict and paper-style, side by side with the paper's own numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import msgspec
from ecm_checker.finding import DIMENSIONS, Dimension

from ecm_corpus.grade import Graded, Method, graded
from ecm_corpus.interface import SUBSTRATES, Substrate
from ecm_corpus.methods import baselines, checker_only, full, without_dimension, without_engine
from ecm_corpus.narrative import GRADES, Narrative
from ecm_corpus.paper import PaperTables
from ecm_corpus.results import ENGINES, CaseResult, Results
from ecm_corpus.statistics import Paired, Share, mcnemar, share

STRICT: Final = "strict"
PAPER_STYLE: Final = "paper-style"


class Recall(msgspec.Struct, frozen=True, kw_only=True):
    """One method on one substrate.

    Attributes:
        strict: discriminating cases. attributed: those of them in a gold dimension.
        paper_style: flagged at the broken state in a gold dimension, whatever the states after the repair say.
        paper: hits of the paper's method of that name; None where it has none.
    """

    method: str
    substrate: Substrate
    strict: Share
    attributed: Share
    paper_style: Share
    paper: int | None


class PerDimension(msgspec.Struct, frozen=True):
    """Cases of a gold dimension that were flagged in it, strictly and paper-style, of how many, and the paper's."""

    substrate: Substrate
    dimension: Dimension
    strict: int
    paper_style: int
    total: int
    paper: int | None


class Ablation(msgspec.Struct, frozen=True):
    """Strict and paper-style hits that are left on a substrate without one dimension or engine."""

    substrate: Substrate
    without: str
    strict: int
    paper_style: int


class Controls(msgspec.Struct, frozen=True):
    """States after the repair, and those of them with a finding about the conflict, as `case:state`."""

    substrate: Substrate
    total: int
    alarms: tuple[str, ...]


class Score(msgspec.Struct, frozen=True, kw_only=True):
    """Everything that `ecm-extract score` shows.

    Attributes:
        checker: hash of the checker that judged. extractor: hash of the sources that read.
        broken: links of the chain that do not hold. missing: repositories without a clone, by case.
        recall, dimensions, ablations, controls, mcnemar: the tables. grades: cases by substrate and grade.
        ledger: one row a case.
    """

    checker: str
    extractor: str
    broken: tuple[str, ...]
    missing: dict[str, tuple[str, ...]]
    recall: tuple[Recall, ...]
    mcnemar: dict[Substrate, dict[str, Paired]]
    dimensions: tuple[PerDimension, ...]
    ablations: tuple[Ablation, ...]
    controls: tuple[Controls, ...]
    grades: dict[Substrate, dict[str, int]]
    ledger: tuple[Graded, ...]


def score(
    results: Results, narratives: dict[str, Narrative], paper: PaperTables, broken: tuple[str, ...] = ()
) -> Score:
    """Score the results of a blind run against the narratives.

    Args:
        results: of the run.
        narratives: by case; a case without one is left out.
        paper: its tables.
        broken: what does not hold in the chain of the results.
    """
    judged = _Judged(results, narratives)
    ledger = judged.by(full())
    used = [substrate for substrate in SUBSTRATES if judged.on(ledger, substrate)]
    return Score(
        checker=results.checker,
        extractor=results.extractor,
        broken=broken,
        missing={case.case: case.missing for case in results.cases if case.missing},
        recall=tuple(_recall(judged, method, substrate, paper) for substrate in used for method in _methods()),
        mcnemar={substrate: _paired(judged, substrate) for substrate in used},
        dimensions=tuple(row for substrate in used for row in _dimensions(judged.on(ledger, substrate), paper)),
        ablations=tuple(row for substrate in used for row in _ablations(judged, substrate)),
        controls=tuple(_controls(substrate, judged.on(ledger, substrate)) for substrate in used),
        grades={substrate: _grades(judged.on(ledger, substrate)) for substrate in used},
        ledger=tuple(ledger),
    )


class _Judged:
    """The cases that can be scored, by any method."""

    def __init__(self, results: Results, narratives: dict[str, Narrative]) -> None:
        self.cases: list[tuple[CaseResult, Narrative]] = [
            (case, narratives[case.case]) for case in results.cases if case.case in narratives
        ]

    def by(self, method: Method) -> list[Graded]:
        return [graded(case, narrative, method) for case, narrative in self.cases]

    def on(self, rows: Sequence[Graded], substrate: Substrate) -> list[Graded]:
        return [row for row in rows if row.substrate == substrate]


def _methods() -> tuple[Method, ...]:
    return (full(), checker_only(), *baselines())


def _recall(judged: _Judged, method: Method, substrate: Substrate, paper: PaperTables) -> Recall:
    rows = judged.on(judged.by(method), substrate)
    total = len(rows)
    return Recall(
        method=method.name,
        substrate=substrate,
        strict=share(sum(row.strict for row in rows), total),
        attributed=share(sum(row.strict and row.attributed for row in rows), total),
        paper_style=share(sum(row.attributed for row in rows), total),
        paper=paper.recall.get(substrate, {}).get(method.name),
    )


def _paired(judged: _Judged, substrate: Substrate) -> dict[str, Paired]:
    """Ours against schema + QoS, the strongest baseline."""
    ours = judged.on(judged.by(full()), substrate)
    theirs = judged.on(judged.by(baselines()[1]), substrate)
    return {
        STRICT: mcnemar([row.strict for row in ours], [row.strict for row in theirs]),
        PAPER_STYLE: mcnemar([row.attributed for row in ours], [row.attributed for row in theirs]),
    }


def _dimensions(rows: Sequence[Graded], paper: PaperTables) -> list[PerDimension]:
    found = []
    for dimension in DIMENSIONS:
        gold = [row for row in rows if dimension in row.gold]
        hits = [row for row in gold if dimension in row.fired]
        if gold:
            known = paper.dimensions.get(rows[0].substrate, {}).get(dimension)
            strict = sum(row.strict for row in hits)
            found.append(PerDimension(rows[0].substrate, dimension, strict, len(hits), len(gold), known))
    return found


def _ablations(judged: _Judged, substrate: Substrate) -> list[Ablation]:
    methods = [*map(without_dimension, DIMENSIONS), *map(without_engine, ENGINES)]
    found = []
    for method in methods:
        rows = judged.on(judged.by(method), substrate)
        strict, style = sum(row.strict for row in rows), sum(row.attributed for row in rows)
        found.append(Ablation(substrate, method.name.removeprefix("without "), strict, style))
    return found


def _controls(substrate: Substrate, rows: Sequence[Graded]) -> Controls:
    judged = [row for row in rows if row.grade != "not_scorable"]
    alarms = tuple(f"{row.case}:{state}" for row in judged for state in row.alarms)
    return Controls(substrate, sum(row.controls for row in judged), alarms)


def _grades(rows: Sequence[Graded]) -> dict[str, int]:
    return {grade: sum(row.grade == grade for row in rows) for grade in GRADES}
