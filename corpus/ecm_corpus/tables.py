"""The score as tables of text, which every format of words renders."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from ecm_corpus.grade import Graded
from ecm_corpus.narrative import GRADES
from ecm_corpus.score import Score
from ecm_corpus.statistics import Share

_SHORT = {
    "signature": "Sig",
    "behavior": "Beh",
    "resources": "Res",
    "permissions": "Perm",
    "recovery": "Rec",
    "versioning": "Ver",
}


class Table(msgspec.Struct, frozen=True):
    """A title, a sentence that says how to read it, the header, and the rows."""

    title: str
    reading: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def tables(score: Score) -> Iterator[Table]:
    """Yield the tables in the order of the paper, the audit and the ledger after them."""
    yield _recall(score)
    yield _mcnemar(score)
    yield _dimensions(score)
    yield _ablation(score)
    yield _controls(score)
    yield _grades(score)
    yield _ledger(score)


def _recall(score: Score) -> Table:
    return Table(
        "Recall",
        "Strict: flagged at the broken state and quiet at every real state after the repair. In gold: those in a "
        "dimension that the record names. Paper-style: flagged in a gold dimension, whatever the repaired states say. "
        "95 % Wilson intervals.",
        ("substrate", "method", "strict", "in gold", "paper-style", "paper"),
        tuple(
            (
                row.substrate,
                row.method,
                _share(row.strict),
                f"{row.attributed.hits}/{row.attributed.total}",
                _share(row.paper_style),
                "-" if row.paper is None else f"{row.paper}/{row.strict.total}",
            )
            for row in score.recall
        ),
    )


def _mcnemar(score: Score) -> Table:
    rows = []
    for substrate, pairs in score.mcnemar.items():
        for style, pair in pairs.items():
            rows.append((substrate, style, str(pair.first_only), str(pair.second_only), f"{pair.p:.2g}"))
    return Table(
        "Exact McNemar test against schema + QoS",
        "Cases that only ours has, cases that only the baseline has, and the two-sided p value.",
        ("substrate", "score", "ours only", "baseline only", "p"),
        tuple(rows),
    )


def _dimensions(score: Score) -> Table:
    return Table(
        "Recall by gold dimension",
        "A case with two gold dimensions counts under each.",
        ("substrate", "dimension", "strict", "paper-style", "paper"),
        tuple(
            (
                row.substrate,
                row.dimension,
                f"{row.strict}/{row.total}",
                f"{row.paper_style}/{row.total}",
                "-" if row.paper is None else f"{row.paper}/{row.total}",
            )
            for row in score.dimensions
        ),
    )


def _ablation(score: Score) -> Table:
    whole = {row.substrate: row for row in score.recall if row.method.startswith("ECM")}
    rows = []
    for row in score.ablations:
        strict, style = whole[row.substrate].strict.hits, whole[row.substrate].paper_style.hits
        if (row.strict, row.paper_style) != (strict, style):
            rows.append((row.substrate, row.without, f"{row.strict - strict:+d}", f"{row.paper_style - style:+d}"))
    return Table(
        "Ablation",
        "What is lost without a dimension or an engine; those that lose nothing are left out.",
        ("substrate", "without", "strict", "paper-style"),
        tuple(rows),
    )


def _controls(score: Score) -> Table:
    return Table(
        "States after the repair",
        "Real refs, none of them blanked. An alarm is a finding of the scored kind about the conflict.",
        ("substrate", "states", "quiet", "alarms"),
        tuple(
            (row.substrate, str(row.total), str(row.total - len(row.alarms)), ", ".join(row.alarms) or "-")
            for row in score.controls
        ),
    )


def _grades(score: Score) -> Table:
    return Table(
        "Grades of evidence",
        "Discriminating counts in the strict score; the others do not.",
        ("substrate", *(grade.replace("_", " ") for grade in GRADES)),
        tuple((substrate, *(str(found[grade]) for grade in GRADES)) for substrate, found in score.grades.items()),
    )


def _ledger(score: Score) -> Table:
    return Table(
        "Ledger",
        "What fired at the broken state about the conflict, beside what fired in the paper.",
        ("case", "gold", "paper", "fired", "grade", "rules", "audit"),
        tuple(_row(row) for row in score.ledger),
    )


def _row(row: Graded) -> tuple[str, ...]:
    paper = "?" if row.paper is None else _dims(row.paper)
    grade = row.grade.replace("_", " ")
    return row.case, _dims(row.gold), paper, _dims(row.fired), grade, " ".join(row.rules) or "-", row.audit.strip()


def _dims(dimensions: tuple[str, ...]) -> str:
    return "/".join(_SHORT[dimension] for dimension in dimensions) or "-"


def _share(share: Share) -> str:
    return f"{share.hits}/{share.total} [{share.low:.0%}, {share.high:.0%}]".replace("%, ", ", ")
