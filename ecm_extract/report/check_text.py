"""A report of the checker as text for people and as a JSON document."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from ecm_checker.finding import Finding
from ecm_checker.freeze import verify
from ecm_checker.json_data import record_data
from ecm_checker.outcome import Report

from ecm_extract.report.findings.data import finding_data
from ecm_extract.report.terminal import one_line

_WIDEST = 2000
_MOST_LINES = 6


def report_json(report: Report) -> str:
    """One JSON document; `checker` holds the content hash and whether it is the pinned one."""
    data = {**record_data(report), "findings": [finding_data(each) for each in report.findings]}
    frozen = verify()
    data["checker"] = {"hash": frozen.current, "frozen": frozen.holds}
    return json.dumps(data, indent=1) + "\n"


def report_text(report: Report) -> str:
    """Findings, one paragraph each; empty when there are none."""
    return findings_text(report.findings)


def findings_text(findings: Iterable[Finding]) -> str:
    """Findings of contracts, one paragraph each: nothing of a source can answer them, so none says how to accept it."""
    return "".join(f"{line}\n" for finding in findings for line in _finding(finding))


def summary_text(report: Report) -> str:
    """Outcome, conditions, what was not asked, and which checker decided."""
    frozen = verify()
    lines = [f"{report.operation}: {report.outcome.replace('_', ' ')}"]
    lines += [f"  condition: {one_line(text, _WIDEST)}" for text in report.conditions]
    lines += [f"  not asked: {text}" for text in report.not_asked]
    pinned = "pinned" if frozen.holds else "not the pinned one"
    lines.append(f"  dimensions: {', '.join(report.dimensions)}; checker {frozen.current[:12]} ({pinned})")
    return "".join(f"{line}\n" for line in lines)


def _finding(finding: Finding) -> Iterator[str]:
    doubt = "" if finding.certainty == "proved" else f" ({finding.certainty})"
    yield one_line(f"{finding.severity}{doubt} {finding.rule} {finding.name}: {finding.message}", _WIDEST)
    yield one_line(f"    fix: {finding.resolution}", _WIDEST)
    for place in finding.evidence[:_MOST_LINES]:
        yield one_line(f"    at {place.path}:{place.line}", _WIDEST)
    if len(finding.evidence) > _MOST_LINES:
        yield f"    and {len(finding.evidence) - _MOST_LINES} more lines"
