"""Findings that a person has answered: by the baseline, an accepted row, or a comment."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from ecm_checker.finding import Finding

from ecm_extract.answers.accepted_file import accepted_file, accepted_in
from ecm_extract.answers.answered import Answered, Answers, answered
from ecm_extract.answers.scope import Scope
from ecm_extract.answers.shown import remember, shown_of
from ecm_extract.lint.baseline_file import FILE_NAME, read_baseline
from ecm_extract.lint.request import Linted, LintRequest
from ecm_extract.own_files import own_file


def baseline_of(request: LintRequest, named: str | None) -> Path:
    """Return the file of the baseline: the named one, else that of the folder."""
    return Path(named) if named else own_file(request.folder, FILE_NAME)


def answered_findings(found: Linted, request: LintRequest, baseline: Path) -> Answered:
    """Return what is left of the findings, and which answers match nothing; what is shown is remembered."""
    left = _without_baseline(found.findings, baseline)
    accepted = accepted_file(request.folder)
    today = datetime.now(tz=UTC).date()
    remember(shown_of(left, accepted))
    scopes: tuple[Scope, ...] = ("tree",) if request.is_whole else ()
    return answered(left, Answers(accepted_in(accepted), found.workspace.files.read, today, scopes))


def _without_baseline(findings: Sequence[Finding], baseline: Path) -> list[Finding]:
    known = read_baseline(baseline.read_text("utf-8", errors="replace")) if baseline.is_file() else frozenset()
    return [each for each in findings if each.fingerprint not in known]
