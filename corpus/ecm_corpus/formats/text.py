"""For a terminal: aligned columns; the audit of the ledger is left to the other formats."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Final

from ecm_corpus.score import Score
from ecm_corpus.tables import Table, tables

WIDTH: Final = 100


def render(score: Score) -> str:
    """All tables, and first what is wrong with the results."""
    parts = [*_warnings(score), *(_table(table) for table in tables(score))]
    return "\n".join(parts) + f"\nchecker {score.checker[:12]}, extractor {score.extractor[:12]}\n"


def _warnings(score: Score) -> list[str]:
    found = [f"BROKEN CHAIN: {text}\n" for text in score.broken]
    return found + [f"not judged: {case} lacks {', '.join(urls)}\n" for case, urls in score.missing.items()]


def _table(table: Table) -> str:
    header, rows = table.header, table.rows
    if header[-1] == "audit":
        header, rows = header[:-1], tuple(row[:-1] for row in rows)
    widths = [max(len(row[at]) for row in (header, *rows)) for at in range(len(header))]
    lines = [_line(header, widths), _line(["-" * width for width in widths], widths)]
    lines += [_line(row, widths) for row in rows]
    reading = textwrap.fill(table.reading, WIDTH)
    return f"{table.title}\n{reading}\n\n" + "\n".join(lines) + "\n"


def _line(cells: Sequence[str], widths: Sequence[int]) -> str:
    return "  ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True)).rstrip()
