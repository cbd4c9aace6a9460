"""Findings as workflow commands, which a code host shows on the lines of a change."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_checker.finding import Finding

from ecm_extract.report.findings.sentence import sentences

_LEVELS = {"error": "error", "warning": "warning", "info": "notice"}


def render(findings: Sequence[Finding]) -> str:
    """Return one command a finding."""
    return "".join(f"{_command(finding)}\n" for finding in findings)


def _command(finding: Finding) -> str:
    place = finding.evidence[0] if finding.evidence else None
    column = f"col={place.column}," if place and place.column else ""
    where = f"file={_property(place.path)},line={max(place.line, 1)},{column}" if place else ""
    title = _property(f"{finding.rule} {finding.name}")
    return f"::{_LEVELS[finding.severity]} {where}title={title}::{_data(sentences(finding))}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
