"""Findings as one JSON document (`ecm-extract/lint/1`)."""

from __future__ import annotations

import json
from collections.abc import Sequence

from ecm_checker.finding import Finding

from ecm_extract.report.findings.data import finding_data

SCHEMA = "ecm-extract/lint/1"


def lint_json(findings: Sequence[Finding]) -> str:
    """Return the document, indented by one space."""
    return json.dumps({"schema": SCHEMA, "findings": [finding_data(each) for each in findings]}, indent=1) + "\n"
