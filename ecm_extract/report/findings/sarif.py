"""Findings as SARIF 2.1.0, which code hosts show on the lines of a change."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.metadata import version
from typing import Any
from urllib.parse import quote

from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding

from ecm_extract.errors import InputError
from ecm_extract.report.findings.sentence import sentences
from ecm_extract.rule_pages import page_of

_LEVELS = {"error": "error", "warning": "warning", "info": "note"}
_SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def render(findings: Sequence[Finding]) -> str:
    """Return one run with the rules that it uses."""
    rules = {finding.rule: finding for finding in findings}
    document = {
        "$schema": _SCHEMA,
        "version": "2.1.0",
        "runs": [
            {
                "tool": {
                    "driver": {
                        "name": "ecm-extract",
                        "version": version("ecm-extract"),
                        "rules": [_rule(rule, rules[rule]) for rule in sorted(rules)],
                    }
                },
                "results": [_result(finding) for finding in findings],
            }
        ],
    }
    return json.dumps(document, indent=1) + "\n"


def _rule(rule: str, finding: Finding) -> dict[str, Any]:
    return {
        "id": rule,
        "name": finding.name,
        "shortDescription": {"text": finding.name.replace("_", " ")},
        "help": {"text": finding.resolution, **_page(rule)},
        "properties": {"dimension": finding.dimension},
    }


def _page(rule: str) -> dict[str, str]:
    """The page of the rule, which code hosts show beside the finding; nothing where pages are not installed."""
    try:
        return {"markdown": page_of(rule)}
    except InputError:
        return {}


def _result(finding: Finding) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": finding.rule,
        "level": _LEVELS[finding.severity],
        "message": {"text": sentences(finding)},
        "partialFingerprints": {"ecmExtract/v1": finding.fingerprint},
        "properties": {"certainty": finding.certainty, "breaks": finding.who},
    }
    if finding.evidence:
        result["locations"] = [_location(finding.evidence[0])]
    if len(finding.evidence) > 1:
        result["relatedLocations"] = [_location(place) for place in finding.evidence[1:20]]
    return result


def _location(place: Evidence) -> dict[str, Any]:
    uri = quote(place.path)
    column = {"startColumn": place.column} if place.column else {}
    region = {"region": {"startLine": place.line, **column}} if place.line > 0 else {}
    return {"physicalLocation": {"artifactLocation": {"uri": uri, "uriBaseId": "%SRCROOT%"}, **region}}
