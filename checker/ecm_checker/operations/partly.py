"""A report on subjects that could not be read as a whole: what was found holds, what was not found may be unread."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache

import msgspec

from ecm_checker.catalogue import catalogue
from ecm_checker.finding import Finding
from ecm_checker.outcome import Report, decided
from ecm_checker.wire import NotRead


def partly_read(report: Report, unread: Iterable[NotRead]) -> Report:
    """Return the report with what could not be read of its subjects.

    Args:
        report: on what could be read.
        unread: of the trees or documents of its subjects; what was left out on purpose does not count.
    """
    gaps = tuple(dict.fromkeys(each for each in unread if each.is_gap))
    if not gaps:
        return report
    return decided(msgspec.structs.replace(report, unread=gaps), map(_in_part, report.findings))


def _in_part(finding: Finding) -> Finding:
    """What somebody misses is a doubt where it may be in what could not be read."""
    if not _by_absence().get(finding.rule, False):
        return finding
    severity = "warning" if finding.severity == "error" else finding.severity
    message = f"in what could be read: {finding.message}"
    return msgspec.structs.replace(finding, severity=severity, certainty="unknown", message=message)


@cache
def _by_absence() -> Mapping[str, bool]:
    return {entry.rule.id: entry.rule.by_absence for entry in catalogue()}
