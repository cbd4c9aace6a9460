"""An extraction in words for a person: what was found, and what could not be resolved and why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import TextIO

from ecm_checker.fields import required_fields
from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from ecm_extract.extraction_model import Extraction
from ecm_extract.report.gaps import Gap, gaps, interfaces, modules
from ecm_extract.report.terminal import one_line

_SHOWN_GAPS = 12
_SHOWN_SPOTS = 5
_SHOWN_FIELDS = 4
_WIDTH_OF_A_FILE = 100


def print_summary(extraction: Extraction, file: TextIO, width: int | None = None) -> None:
    """Print the summary; in colour on a terminal, unless NO_COLOR is set.

    Args:
        extraction: what was read.
        file: where to; standard output or standard error.
        width: columns; None takes those of the terminal, 100 for a file.
    """
    console = Console(file=file, width=width, highlight=False, markup=False, emoji=False)
    if width is None and not console.is_terminal:
        console.width = _WIDTH_OF_A_FILE
    console.print(_headline(extraction))
    console.print(_counted("modules", Counter(each.ecm.kind for each in modules(extraction))))
    _print_endpoints(extraction, console)
    _print_completeness(extraction, console)
    _print_gaps(gaps(extraction), console)


def _headline(extraction: Extraction) -> Text:
    found, read = len(extraction.packages), extraction.counts
    commit = f" ({extraction.commit[:12]})" if extraction.commit else ""
    return Text.assemble(
        (one_line(extraction.path), "bold"),
        f"{one_line(commit)}: {_plural(found, 'package')}, "
        f"{_plural(sum(1 for _ in modules(extraction)), 'module')} "
        f"from {_plural(read.files, 'file')} ({_size(read.bytes)}) in {extraction.elapsed:.1f} s",
    )


def _print_endpoints(extraction: Extraction, console: Console) -> None:
    every, named = Counter[str](), Counter[str]()
    for each in interfaces(extraction):
        every[each.role] += 1
        named[each.role] += each.confidence != "pattern"
    if not every:
        return
    table = Table(box=None, pad_edge=False, header_style="bold", padding=(0, 2, 0, 0))
    table.add_column("role")
    table.add_column("found", justify="right")
    table.add_column("name resolved", justify="right")
    for role, count in sorted(every.items(), key=lambda item: (-item[1], item[0])):
        table.add_row(role, f"{count:,}", _share(named[role], count))
    table.add_row("all", f"{every.total():,}", _share(named.total(), every.total()), style="bold")
    console.print()
    console.print(table)


def _print_completeness(extraction: Extraction, console: Console) -> None:
    missing = Counter(field for module in modules(extraction) for field in module.missing)
    asked = sum(len(required_fields(module.ecm.kind)) for module in modules(extraction))
    if not asked:
        return
    filled = asked - missing.total()
    console.print()
    console.print(Text(f"required fields filled: {filled:,} of {asked:,} ({_share(filled, asked)})"))
    if missing:
        often = ", ".join(f"{field} {count}" for field, count in _largest(missing.items())[:_SHOWN_FIELDS])
        console.print(_indented(f"most often missing: {often}", 2, "dim"))


def _print_gaps(found: list[Gap], console: Console) -> None:
    if not found:
        return
    console.print()
    console.print(Text("not resolved", style="bold"))
    for gap in found[:_SHOWN_GAPS]:
        console.print(_indented(f"{gap.count:,} × {one_line(gap.cause)}", 2, "yellow"))
        for spot in gap.spots[:_SHOWN_SPOTS]:
            console.print(_indented(f"{one_line(spot.place)}  {one_line(spot.detail)}", 6, "dim"))
        if len(gap.spots) > _SHOWN_SPOTS:
            console.print(_indented(f"and {_plural(len(gap.spots) - _SHOWN_SPOTS, 'more place')}", 6, "dim"))
    if len(found) > _SHOWN_GAPS:
        rest = len(found) - _SHOWN_GAPS
        console.print(_indented(f"and {_plural(rest, 'more cause')}", 2, ""))
    console.print(
        _indented("all of them: --format json, by `confidence: pattern`, `type: null` and `diagnostics`", 2, "dim")
    )


def _counted(title: str, counts: Counter[str]) -> Text:
    parts = ", ".join(f"{one_line(name)} {count:,}" for name, count in _largest(counts.items()))
    return Text(f"{title}: {parts or 'none'}")


def _largest(items: Iterable[tuple[str, int]]) -> list[tuple[str, int]]:
    return sorted(items, key=lambda item: (-item[1], item[0]))


def _indented(text: str, columns: int, style: str) -> Padding:
    return Padding(Text(text, style=style, overflow="fold"), (0, 0, 0, columns), expand=False)


def _size(count: int) -> str:
    return f"{count / 1e6:,.1f} MB" if count >= 1e6 else f"{count / 1e3:,.1f} kB"


def _plural(count: int, noun: str) -> str:
    return f"{count:,} {noun}" if count == 1 else f"{count:,} {noun}s"


def _share(part: int, whole: int) -> str:
    """Rounded down, so that only all of it is 100 %."""
    return f"{100 * part // whole} %"
