"""A comment for a pull request: verdict, who breaks, what changed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.release import Change, fingerprint_of

from ecm_extract.diff.formats.below import with_it
from ecm_extract.diff.formats.migration import escape
from ecm_extract.diff.formats.phrases import by_package, incomplete, left_out, place, step_lines, subject, values
from ecm_extract.diff.model import Comparison
from ecm_extract.diff.steps import short_steps
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
    yield f"**Interface changes: {verdict.compatibility_class}.** Needs {needed(verdict)}, declares {declared}.{told}"
    yield ""
    steps = list(step_lines(short_steps(comparison)))
    for line in steps:
        yield f"- {escape(line)}"
    if steps:
        yield ""
    for finding in comparison.findings:
        at = finding.evidence[0]
        yield f"- **{finding.severity}** `{escape(at.path)}:{at.line}` {escape(finding.message)}"
    if comparison.findings:
        yield ""
    rows = [change for _, changes in by_package(comparison.changes) for change in changes if _is_row(change)]
    if rows:
        yield "| package | change | entity | where | accept |"
        yield "|---|---|---|---|---|"
    below = with_it(comparison.changes)
    for change in rows[:MAX_ROWS]:
        what = "; ".join(filter(None, (f"{subject(change)}{values(change)}", below(change))))
        cells = (change.package, change.change, what, place(change), _answer(change, comparison))
        yield f"| {' | '.join(map(escape, cells))} |"
    if len(rows) > MAX_ROWS:
        yield ""
        yield f"and {len(rows) - MAX_ROWS} more breaking changes"
    yield from _compatible([change for change in comparison.changes if not change.breaking])
    for line in left_out(comparison):
        yield ""
        yield f"Not read: {escape(line)}."


def _answer(change: Change, comparison: Comparison) -> str:
    fingerprint = fingerprint_of(change)
    return "accepted" if fingerprint in comparison.accepted else f"`{fingerprint}`"


def _compatible(changes: list[Change]) -> Iterator[str]:
    """How many compatible changes there are; defaults with their values, for they are felt without an error."""
    yield ""
    yield f"{len(changes)} compatible changes."
    defaults = [change for change in changes if change.change == "default_changed"]
    if defaults:
        yield ""
    for change in defaults[:MAX_ROWS]:
        yield f"- default of {escape(subject(change))}{escape(values(change))}"
    if len(defaults) > MAX_ROWS:
        yield f"- and {len(defaults) - MAX_ROWS} more defaults"


def _is_row(change: Change) -> bool:
    """Whether a change breaks somebody, and nothing else in the table explains it."""
    return change.breaking and not change.cause
