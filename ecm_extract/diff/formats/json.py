"""The wire format `ecm-extract/diff/1`."""

from __future__ import annotations

from typing import Any, Final

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.json_data import record_data

from ecm_extract.diff.model import Comparison, RefInfo

SCHEMA: Final = "ecm-extract/diff/1"


def diff_document(comparison: Comparison) -> dict[str, Any]:
    """Plain data of a comparison; keys are those of DESIGN §6."""
    return {
        "schema": SCHEMA,
        "repo": comparison.repo,
        "old": _ref(comparison.old),
        "new": _ref(comparison.new),
        "changes": [record_data(change) for change in comparison.changes],
        "findings": [_finding(finding) for finding in comparison.findings],
        "verdict": msgspec.to_builtins(comparison.verdict),
        "packages": [
            {
                "package": entry.package,
                "old_version": entry.old_version,
                "new_version": entry.new_version,
                **msgspec.to_builtins(entry.verdict),
            }
            for entry in comparison.packages
        ],
    }


def _ref(info: RefInfo) -> dict[str, Any]:
    return {"ref": info.ref, "commit": info.commit}


def _finding(finding: Finding) -> dict[str, Any]:
    """A finding with every key of its places, so that readers need no defaults."""
    places = [{**record_data(place), "end_line": place.end_line, "commit": place.commit} for place in finding.evidence]
    return {**record_data(finding), "evidence": places}


def render(comparison: Comparison) -> str:
    """Return the document as text, indented by one space."""
    data = msgspec.json.encode(diff_document(comparison))
    return msgspec.json.format(data, indent=1).decode() + "\n"
