"""The four outcomes, and the report that carries one.

Source: paper, "Compatibility Outcomes".
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, Literal

import msgspec

from ecm_checker.finding import SEVERITIES, Dimension, Finding
from ecm_checker.wire import NotRead

Outcome = Literal["accept", "accept_with_conditions", "reject", "review"]

REPORT_SCHEMA: Final = "ecm-extract/check/1"
_WORST_FIRST: Final[tuple[Outcome, ...]] = ("reject", "review", "accept_with_conditions", "accept")


class Report(msgspec.Struct, frozen=True, kw_only=True):
    """What an operation decided.

    Attributes:
        operation: name of the operation.
        outcome: see `decide`.
        conditions: under which it is accepted; empty for the other outcomes.
        findings: most severe first, then by rule and subjects.
        dimensions: those that were consulted.
        not_asked: sub-checks that nothing could be asked of, as their profile was not given, and requirements that
            could not be matched.
        checker: content hash of the rules that decided.
        unread: what could declare interfaces of the subjects and could not be read: no outcome is milder than review.
    """

    schema: str = REPORT_SCHEMA
    operation: str
    outcome: Outcome
    conditions: tuple[str, ...]
    findings: tuple[Finding, ...]
    dimensions: tuple[Dimension, ...]
    not_asked: tuple[str, ...]
    checker: str
    unread: tuple[NotRead, ...] = ()


def decide(findings: Iterable[Finding]) -> Outcome:
    """The outcome of findings: the worst that any of them asks for.

    An error rejects; a doubt about something that matters (not merely `info`) asks for a review; a warning is a
    condition; an information changes nothing.
    """
    return worst(map(_asked_by, findings))


def decided(report: Report, findings: Iterable[Finding]) -> Report:
    """The report with other findings: of what was not read as a whole nothing is accepted."""
    listed = ordered(findings)
    outcome = worst((decide(listed), *(["review"] if report.unread else ())))
    kept = conditions(listed) if outcome == "accept_with_conditions" else ()
    return msgspec.structs.replace(report, findings=listed, outcome=outcome, conditions=kept)


def worst(outcomes: Iterable[Outcome]) -> Outcome:
    """The worst of outcomes; accept when there are none."""
    present = set(outcomes)
    return next((outcome for outcome in _WORST_FIRST if outcome in present), "accept")


def ordered(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Findings without repetition, most severe first; the order does not depend on that of the input."""
    distinct = {(found.fingerprint, found.subjects, found.severity): found for found in findings}
    return tuple(sorted(distinct.values(), key=_order))


def conditions(findings: Iterable[Finding]) -> tuple[str, ...]:
    """What must be done or verified for an acceptance to hold, each once."""
    return tuple(dict.fromkeys(found.resolution for found in findings if found.severity == "warning"))


def _asked_by(finding: Finding) -> Outcome:
    if finding.severity == "error":
        return "reject"
    if finding.severity == "info":
        return "accept"
    return "review" if finding.certainty == "unknown" else "accept_with_conditions"


def _order(finding: Finding) -> tuple[int, str, tuple[str, ...], str]:
    return SEVERITIES.index(finding.severity), finding.rule, finding.subjects, finding.fingerprint
