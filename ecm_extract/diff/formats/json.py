"""The wire format `ecm-extract/diff/1`."""

from __future__ import annotations

from typing import Any, Final

import msgspec
from ecm_checker.json_data import record_data
from ecm_checker.release import Change, fingerprint_of

from ecm_extract.diff.model import Comparison, RefInfo
from ecm_extract.diff.steps import short_steps
from ecm_extract.report.findings.data import finding_data

SCHEMA: Final = "ecm-extract/diff/1"


def diff_document(comparison: Comparison) -> dict[str, Any]:
    """Plain data of a comparison; keys are those of DESIGN §6."""
    return {
        "schema": SCHEMA,
        "repo": comparison.repo,
        "old": _ref(comparison.old),
        "new": _ref(comparison.new),
        "changes": [_change(change, comparison) for change in comparison.changes],
        "findings": [finding_data(finding) for finding in comparison.findings],
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
        "unread": [record_data(part) for part in comparison.unread],
        "short_steps": [msgspec.to_builtins(step) for step in short_steps(comparison)],
    }


def _ref(info: RefInfo) -> dict[str, Any]:
    """The side; that files are not those of the commit is said only where it is so."""
    return {"ref": info.ref, "commit": info.commit, **({"uncommitted": True} if info.uncommitted else {})}


def _change(change: Change, comparison: Comparison) -> dict[str, Any]:
    fingerprint = fingerprint_of(change)
    return {**record_data(change), "fingerprint": fingerprint, "accepted": fingerprint in comparison.accepted}


def render(comparison: Comparison) -> str:
    """Return the document as text, indented by one space."""
    data = msgspec.json.encode(diff_document(comparison))
    return msgspec.json.format(data, indent=1).decode() + "\n"
