"""A finding as data, with the keys of DESIGN §6."""

from __future__ import annotations

from typing import Any

from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding
from ecm_checker.json_data import record_data


def finding_data(finding: Finding) -> dict[str, Any]:
    """Return every key of a finding and of its places, so that readers need no defaults."""
    return {**record_data(finding), "evidence": [_place(place) for place in finding.evidence]}


def _place(place: Evidence) -> dict[str, Any]:
    return {**record_data(place), "end_line": place.end_line or place.line, "commit": place.commit}
