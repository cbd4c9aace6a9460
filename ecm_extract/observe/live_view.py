"""What is seen while it is watched, on a terminal: how much, and the streams that carry most."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Final

from ecm_extract.observe.model import Observation
from ecm_extract.observe.report import counted
from ecm_extract.report.terminal import one_line

if TYPE_CHECKING:
    from rich.table import Table

_ROWS: Final = 12


def last_shown(observations: Iterable[Observation]) -> Observation:
    """Follow observations to the last one and return it; on a terminal each is shown as it comes.

    A person who interrupts has seen enough: then the last one so far is the whole.
    """
    seen: list[Observation] = []
    try:
        for each in _shown(observations):
            seen[:] = [each]
    except KeyboardInterrupt:
        if not seen:
            raise
    return seen[0]


def _shown(observations: Iterable[Observation]) -> Iterator[Observation]:
    if not sys.stderr.isatty():
        yield from observations
        return
    from rich.console import Console
    from rich.live import Live

    with Live(console=Console(stderr=True), transient=True) as live:
        for each in observations:
            live.update(_table(each))
            yield each


def _table(seen: Observation) -> Table:
    from rich.table import Table

    table = Table(title=f"{seen.seconds:.0f} s: {counted(seen)}", title_justify="left")
    for heading in ("topic", "writer", "messages", "Hz", "longest gap"):
        table.add_column(heading)
    for stream in sorted(seen.streams, key=lambda each: -each.count)[:_ROWS]:
        hertz = f"{stream.hz:.1f}" if stream.hz is not None else ""
        gap = f"{stream.longest_gap_s:.2f} s" if stream.longest_gap_s is not None else ""
        table.add_row(one_line(stream.topic), one_line(stream.node or ""), str(stream.count), hertz, gap)
    return table
