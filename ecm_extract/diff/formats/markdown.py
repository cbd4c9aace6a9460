"""A comment for a pull request: verdict, who breaks, what changed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.release import Change

from ecm_extract.diff.formats.below import with_it
from ecm_extract.diff.formats.migration import escape
from ecm_extract.diff.formats.phrases import by_package, place, subject
from ecm_extract.diff.model import Comparison

MAX_ROWS = 60


def render(comparison: Comparison) -> str:
    """Return the comment."""
    return "\n".join(_lines(comparison)) + "\n"


def _lines(comparison: Comparison) -> Iterator[str]:
    verdict = comparison.verdict
    declared = verdict.declared_bump or "unknown"
    yield f"**Interface changes: {verdict.compatibility_class}.** Needs {verdict.required_bump}, declared {declared}."
    yield ""
    for finding in comparison.findings:
        at = finding.evidence[0]
        yield f"- **{finding.severity}** `{escape(at.path)}:{at.line}` {escape(finding.message)}"
    if comparison.findings:
        yield ""
    rows = [change for _, changes in by_package(comparison.changes) for change in changes if _is_row(change)]
    if rows:
        yield "| package | change | entity | where |"
        yield "|---|---|---|---|"
    below = with_it(comparison.changes)
    for change in rows[:MAX_ROWS]:
        what = "; ".join(filter(None, (subject(change), below(change))))
        cells = (change.package, change.change, what, place(change))
        yield f"| {' | '.join(map(escape, cells))} |"
    if len(rows) > MAX_ROWS:
        yield ""
        yield f"and {len(rows) - MAX_ROWS} more breaking changes"
    compatible = sum(not change.breaking for change in comparison.changes)
    yield ""
    yield f"{compatible} compatible changes."


def _is_row(change: Change) -> bool:
    """Whether a change breaks somebody, and nothing else in the table explains it."""
    return change.breaking and not change.cause
