"""A comment for a pull request: verdict, who breaks, what changed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_extract.diff.formats.migration import escape
from ecm_extract.diff.formats.phrases import by_package, incomplete, left_out, place, subject
from ecm_extract.diff.model import Comparison
from ecm_extract.diff.verdict import needed

MAX_ROWS = 60


def render(comparison: Comparison) -> str:
    """Return the comment."""
    return "\n".join(_lines(comparison)) + "\n"


def _lines(comparison: Comparison) -> Iterator[str]:
    verdict = comparison.verdict
    declared = verdict.declared_bump or "unknown"
    gap = incomplete(comparison)
    told = f" {escape(gap[0].upper() + gap[1:])}." if gap else ""
    yield f"**Interface changes: {verdict.compatibility_class}.** Needs {needed(verdict)}, declared {declared}.{told}"
    yield ""
    for finding in comparison.findings:
        at = finding.evidence[0]
        yield f"- **{finding.severity}** `{escape(at.path)}:{at.line}` {escape(finding.message)}"
    if comparison.findings:
        yield ""
    rows = [change for _, changes in by_package(comparison.changes) for change in changes if change.breaking]
    if rows:
        yield "| package | change | entity | where |"
        yield "|---|---|---|---|"
    for change in rows[:MAX_ROWS]:
        cells = (change.package, change.change, subject(change), place(change))
        yield f"| {' | '.join(map(escape, cells))} |"
    if len(rows) > MAX_ROWS:
        yield ""
        yield f"and {len(rows) - MAX_ROWS} more breaking changes"
    compatible = sum(not change.breaking for change in comparison.changes)
    yield ""
    yield f"{compatible} compatible changes."
    for line in left_out(comparison):
        yield ""
        yield f"Not read: {escape(line)}."
