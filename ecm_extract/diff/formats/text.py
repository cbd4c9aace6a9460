"""Text for people: findings first, then the changes by package, most breaking first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterator
from typing import NamedTuple

import click
from ecm_checker.release import Change, fingerprint_of

from ecm_extract.diff.formats.below import With, with_it
from ecm_extract.diff.formats.phrases import by_package, incomplete, left_out, place, subject, values
from ecm_extract.diff.model import Comparison
from ecm_extract.diff.verdict import needed
from ecm_extract.report.findings.text import styled as styled_findings
from ecm_extract.report.places import Places
from ecm_extract.report.terminal import one_line

MAX_COMPATIBLE = 12


def render(comparison: Comparison, places: Places) -> str:
    """Return the report."""
    return click.unstyle(styled(comparison, places))


def styled(comparison: Comparison, places: Places) -> str:
    """Return the report with colors for a terminal, and paths as they are opened from here."""
    return "\n".join(_lines(comparison, places)) + "\n"


def _lines(comparison: Comparison, places: Places) -> Iterator[str]:
    gap = incomplete(comparison)
    if gap:
        yield f"{comparison.verdict.compatibility_class}: {gap}"
        yield ""
    if comparison.findings:
        yield styled_findings(comparison.findings, places)
    versions = {entry.package: entry for entry in comparison.packages}
    below = with_it(comparison.changes)
    for package, changes in by_package(comparison.changes):
        entry = versions.get(package)
        head = f"{package}"
        if entry is not None:
            needs, declares = needed(entry.verdict), entry.verdict.declared_bump
            head += f" {entry.old_version or '?'} -> {entry.new_version or '?'}"
            head += f": {entry.verdict.compatibility_class}, needs {needs}, declares {declares or 'unknown'}"
        yield one_line(head, 300)
        yield from _changes(changes, comparison.accepted, Shown(places, below))
        yield ""
    if not comparison.changes:
        yield "no change of a public entity" + (" in what could be read" if gap else "")
    yield from (f"not read: {line}" for line in left_out(comparison))


class Shown(NamedTuple):
    """How a change is written: its paths, and what goes with it."""

    places: Places
    below: With


def _changes(changes: list[Change], accepted: Container[str], shown: Shown) -> Iterator[str]:
    breaking = [change for change in changes if change.breaking and not change.cause]
    rest = [change for change in changes if not change.breaking]
    for change in breaking:
        fingerprint = fingerprint_of(change)
        answer = "accepted" if fingerprint in accepted else fingerprint
        mark = click.style("!", fg="red", bold=True) if answer == fingerprint else " "
        yield f"  {mark} {change.change:<17} {subject(change)} [{answer}]"
        yield one_line(f"      {place(change, shown.places.from_here)}  {change.reason}", 400)
        if shown.below(change):
            yield f"      {shown.below(change)}"
    for change in rest[:MAX_COMPATIBLE]:
        yield f"    {change.change:<17} {subject(change)}{values(change)}"
    if len(rest) > MAX_COMPATIBLE:
        counts = Counter(f"{change.kind.replace('_', ' ')} {change.change}" for change in rest[MAX_COMPATIBLE:])
        listed = ", ".join(f"{count} {name}" for name, count in counts.most_common(6))
        yield f"    and {len(rest) - MAX_COMPATIBLE} more compatible changes: {listed}"
