"""Findings as text, one paragraph each; nothing when there are none."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_checker.finding import Finding

from ecm_extract.report.terminal import one_line

_WIDEST = 2000
_MOST_LINES = 6


def render(findings: Sequence[Finding]) -> str:
    """Return the text."""
    return "".join(f"{one_line(line, _WIDEST)}\n" for finding in findings for line in _lines(finding))


def _lines(finding: Finding) -> Iterator[str]:
    place = finding.evidence[0] if finding.evidence else None
    where = f"{place.path}:{place.line}: " if place else ""
    doubt = "" if finding.certainty == "proved" else f" ({finding.certainty})"
    yield f"{where}{finding.severity}{doubt} {finding.rule} {finding.name}: {finding.message}"
    yield f"    fix: {finding.resolution}"
    for other in finding.evidence[1:_MOST_LINES]:
        yield f"    see {other.path}:{other.line}"
    if len(finding.evidence) > _MOST_LINES:
        yield f"    and {len(finding.evidence) - _MOST_LINES} more lines"
    yield f"    accept: ecm-extract accept {finding.fingerprint} --reason ..."
