"""Findings as one JSON document (`ecm-extract/lint/1`)."""

from __future__ import annotations

import json
from collections.abc import Sequence

from ecm_checker.finding import Finding
from ecm_checker.json_data import record_data

from ecm_extract.lint.completeness import Completeness
from ecm_extract.report.findings.data import finding_data

SCHEMA = "ecm-extract/lint/1"


def lint_json(findings: Sequence[Finding], read: Completeness) -> str:
    """Return the document, indented by one space."""
    document = {
        "schema": SCHEMA,
        "findings": [finding_data(each) for each in findings],
        "complete": read.complete,
        "unread": [record_data(each) for each in read.unread],
    }
    return json.dumps(document, indent=1) + "\n"
