"""Text for people: findings first, then the changes by package, most breaking first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ecm_checker.finding import Finding
from ecm_checker.release import Change

from ecm_extract.diff.formats.below import With, with_it
from ecm_extract.diff.formats.phrases import by_package, place, subject
from ecm_extract.diff.model import Comparison
from ecm_extract.report.terminal import one_line

MAX_COMPATIBLE = 12


def render(comparison: Comparison) -> str:
    """Return the report."""
    return "\n".join(_lines(comparison)) + "\n"


def _lines(comparison: Comparison) -> Iterator[str]:
    for finding in comparison.findings:
        yield from _finding(finding)
    versions = {entry.package: entry for entry in comparison.packages}
    below = with_it(comparison.changes)
    for package, changes in by_package(comparison.changes):
        entry = versions.get(package)
        head = f"{package}"
        if entry is not None:
            needs, takes = entry.verdict.required_bump, entry.verdict.declared_bump
            head += f" {entry.old_version or '?'} -> {entry.new_version or '?'}"
            head += f": {entry.verdict.compatibility_class}, needs {needs}, takes {takes or 'unknown'}"
        yield one_line(head, 300)
        yield from _changes(changes, below)
        yield ""
    if not comparison.changes:
        yield "no change of a public entity"


def _finding(finding: Finding) -> Iterator[str]:
    at = finding.evidence[0]
    yield one_line(f"{at.path}:{at.line}: {finding.severity}: {finding.message} [{finding.rule}]", 1000)
    for other in finding.evidence[1:]:
        yield one_line(f"    {other.path}:{other.line}")
    yield one_line(f"    do: {finding.resolution}", 600)
    yield ""


def _changes(changes: list[Change], below: With) -> Iterator[str]:
    breaking = [change for change in changes if change.breaking and not change.cause]
    rest = [change for change in changes if not change.breaking]
    for change in breaking:
        yield f"  ! {change.change:<17} {subject(change)}"
        yield one_line(f"      {place(change)}  {change.reason}", 400)
        if below(change):
            yield f"      {below(change)}"
    for change in rest[:MAX_COMPATIBLE]:
        yield f"    {change.change:<17} {subject(change)}"
    if len(rest) > MAX_COMPATIBLE:
        counts = Counter(f"{change.kind.replace('_', ' ')} {change.change}" for change in rest[MAX_COMPATIBLE:])
        listed = ", ".join(f"{count} {name}" for name, count in counts.most_common(6))
        yield f"    and {len(rest) - MAX_COMPATIBLE} more compatible changes: {listed}"
