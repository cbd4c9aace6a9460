"""For a page: the tables with the audit of each case."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_corpus.score import Score
from ecm_corpus.tables import Table, tables


def render(score: Score) -> str:
    """All tables as Markdown."""
    head = ["# Evaluation", ""]
    head += [f"**The chain is broken:** {text}\n" for text in score.broken]
    head += [f"Not judged: {case} lacks {', '.join(urls)}.\n" for case, urls in score.missing.items()]
    body = [_table(table) for table in tables(score)]
    return "\n".join([*head, *body, f"Checker `{score.checker}`, extractor `{score.extractor}`."]) + "\n"


def _table(table: Table) -> str:
    lines = [f"## {table.title}", "", table.reading, "", _line(table.header), _line(["---"] * len(table.header))]
    return "\n".join([*lines, *(_line(row) for row in table.rows), ""])


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"
