"""A report of the checker as a JSON document, and its summary for people."""

from __future__ import annotations

import json

from ecm_checker.freeze import verify
from ecm_checker.json_data import record_data
from ecm_checker.outcome import Report

from ecm_extract.report.findings.data import finding_data
from ecm_extract.report.terminal import one_line
from ecm_extract.report.unread_text import unread_lines
from ecm_extract.tree.unread import unread_in

_WIDEST = 2000


def report_json(report: Report) -> str:
    """One JSON document; `checker` holds the content hash and whether it is the pinned one."""
    data = {**record_data(report), "findings": [finding_data(each) for each in report.findings]}
    frozen = verify()
    data["checker"] = {"hash": frozen.current, "frozen": frozen.holds}
    return json.dumps(data, indent=1) + "\n"


def summary_text(report: Report) -> str:
    """Outcome, conditions, what was not asked, and which checker decided."""
    frozen = verify()
    lines = [f"{report.operation}: {report.outcome.replace('_', ' ')}"]
    lines += [f"  condition: {one_line(text, _WIDEST)}" for text in report.conditions]
    lines += [f"  not asked: {text}" for text in report.not_asked]
    lines += [f"  not read: {text}" for text in unread_lines(unread_in(report.unread))]
    pinned = "pinned" if frozen.holds else "not the pinned one"
    lines.append(f"  dimensions: {', '.join(report.dimensions)}; checker {frozen.current[:12]} ({pinned})")
    return "".join(f"{line}\n" for line in lines)
