"""Findings as text: a paragraph for what breaks somebody, a line for what may be known already."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Final

import click
from ecm_checker.finding import Finding, Severity

from ecm_extract.report.terminal import one_line

_WIDEST = 2000
_MOST_LINES = 6
_COLORS: Final[Mapping[Severity, str]] = MappingProxyType({"error": "red", "warning": "yellow", "info": "cyan"})


def render(findings: Sequence[Finding]) -> str:
    """Return the text; empty when there are no findings."""
    return click.unstyle(styled(findings))


def styled(findings: Sequence[Finding]) -> str:
    """Return the text with colors for a terminal."""
    return "".join(f"{line}\n" for finding in findings for line in _lines(finding))


def _lines(finding: Finding) -> Iterator[str]:
    if finding.severity == "info":
        yield f"{_head(finding)} [{finding.fingerprint}]"
        return
    yield _head(finding)
    yield one_line(f"    fix: {finding.resolution}", _WIDEST)
    for other in finding.evidence[1:_MOST_LINES]:
        yield one_line(f"    see {other.path}:{other.line}", _WIDEST)
    if len(finding.evidence) > _MOST_LINES:
        yield f"    and {len(finding.evidence) - _MOST_LINES} more lines"
    yield f"    accept: ecm-extract accept {finding.fingerprint} --reason ..."


def _head(finding: Finding) -> str:
    place = finding.evidence[0] if finding.evidence else None
    where = click.style(one_line(f"{place.path}:{place.line}:"), bold=True) + " " if place else ""
    doubt = "" if finding.certainty == "proved" else f" ({finding.certainty})"
    severity = click.style(finding.severity, fg=_COLORS[finding.severity], bold=True)
    told = one_line(f"{doubt} {finding.rule} {finding.name}: {finding.message}", _WIDEST)
    return f"{where}{severity}{told}"
