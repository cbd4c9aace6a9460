"""All rules over one workspace: findings in a stable order, with the levels that the project sets."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Mapping

import msgspec
from ecm_checker.finding import SEVERITIES, Finding

from ecm_extract.config import Level
from ecm_extract.lint.beside import of_tree
from ecm_extract.lint.catalogue import catalogue
from ecm_extract.lint.left_over import eased, left_over
from ecm_extract.lint.refused import is_refused
from ecm_extract.lint.rules.lnt061 import RULE as REFUSAL
from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree import FileDiagnostic, Unread


def findings_of(
    workspace: Workspace,
    selected: Collection[str] = (),
    levels: Mapping[str, Level] | None = None,
    *,
    preview: bool = True,
) -> list[Finding]:
    """Return what the rules find.

    Args:
        workspace: the tree under lint.
        selected: ids of the rules to run; empty for all.
        levels: severity by rule id, `off` to silence it.
        preview: run the preview rules too.
    """
    found: dict[tuple[str, str, int], Finding] = {}
    old = left_over(workspace)
    for entry in catalogue():
        if entry.rule.tier == "preview" and not preview:
            continue
        level = (levels or {}).get(entry.rule.id)
        if level == "off" or (selected and entry.rule.id not in selected):
            continue
        try:
            for finding in (each for part in workspace.parts for each in of_tree(entry.findings(part))):
                place = finding.evidence[0] if finding.evidence else None
                shown = msgspec.structs.replace(finding, severity=level) if level else eased(finding, old)
                key = (finding.fingerprint, place.path if place else "", place.line if place else 0)
                found.setdefault(key, shown)
        except Exception as error:  # a rule that fails on a stranger's file must not cost what the others found
            if os.environ.get("ECM_DEBUG"):
                raise
            message = f"{entry.rule.id} could not finish ({type(error).__name__}). The other rules are not affected."
            unread = Unread(entry.rule.id, "stopped")
            workspace.tree.report(FileDiagnostic("warning", "rule-stopped", "", 0, message, unread))
    return sorted(_understood(_gravest(found.values()), workspace), key=_order)


def _gravest(findings: Iterable[Finding]) -> Iterator[Finding]:
    """Leave out what says again, and less gravely, what is said of the same cause in the same file."""
    found = list(findings)
    levels: dict[tuple[str, str], int] = {}
    for each in found:
        key = _cause(each)
        levels[key] = min(levels.get(key, len(SEVERITIES)), SEVERITIES.index(each.severity))
    return (each for each in found if SEVERITIES.index(each.severity) == levels[_cause(each)])


def _cause(finding: Finding) -> tuple[str, str]:
    return finding.fingerprint, finding.evidence[0].path if finding.evidence else ""


def _understood(findings: Iterable[Finding], workspace: Workspace) -> Iterator[Finding]:
    """Leave out what is said of lines of a file that its reader refuses, apart from just that."""
    refused: dict[str, bool] = {}
    for finding in findings:
        path = finding.evidence[0].path if finding.evidence else ""
        if path not in refused:
            refused[path] = bool(path) and is_refused(path, workspace)
        if finding.rule == REFUSAL.id or not refused[path]:
            yield finding


def _order(finding: Finding) -> tuple[int, str, int, str]:
    place = finding.evidence[0] if finding.evidence else None
    level = SEVERITIES.index(finding.severity)
    return level, place.path if place else "", place.line if place else 0, finding.rule
