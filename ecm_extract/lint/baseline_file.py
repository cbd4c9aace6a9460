"""A committed list of findings that an old repository starts with: fingerprint, rule and place, one a line."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ecm_checker.finding import Finding

FILE_NAME = "ecm-baseline.txt"
_ROW = re.compile(r"([0-9a-f]{16})\b")


def baseline_text(findings: Iterable[Finding]) -> str:
    """Return the file; only the fingerprint counts, the rest is for people."""
    rows = {finding.fingerprint: _row(finding) for finding in findings}
    head = (
        "# Findings that were there when this file was written. `ecm-extract lint --write-baseline` writes it anew.\n"
    )
    return head + "".join(f"{rows[key]}\n" for key in sorted(rows))


def read_baseline(text: str) -> frozenset[str]:
    """Return the fingerprints of a file."""
    return frozenset(match[1] for line in text.splitlines() if (match := _ROW.match(line)))


def _row(finding: Finding) -> str:
    place = finding.evidence[0] if finding.evidence else None
    return f"{finding.fingerprint} {finding.rule} {place.path if place else ''}"
