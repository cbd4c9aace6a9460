"""Findings without those that a person has answered, and the answers that match nothing."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from datetime import date

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.answers.accepted_file import FILE_NAME, Accepted
from ecm_extract.answers.comments import Comment, Read, comments_in
from ecm_extract.answers.scope import Scope, scope_of


class Answers(msgspec.Struct, frozen=True):
    """What answers findings.

    Attributes:
        rows: of the file; one whose day has passed counts no longer.
        read: gives files of the tree, whose lines may hold a comment.
        today: the day of the run.
        scopes: what the run looks at as a whole, so that an answer that matches nothing there is told.
    """

    rows: Sequence[Accepted]
    read: Read
    today: date
    scopes: Collection[Scope] = ()


class Answered(msgspec.Struct, frozen=True):
    """What is left of the findings, the fingerprints that were answered, and answers that match nothing."""

    findings: tuple[Finding, ...]
    suppressed: int
    fingerprints: frozenset[str]
    unused: tuple[str, ...]


def answered(findings: Iterable[Finding], answers: Answers) -> Answered:
    """Take out what was answered; who answers a change where it is made has answered what it breaks."""
    every = list(findings)
    comments = list(comments_in((each.evidence[0].path for each in every if each.evidence), answers.read))
    matched = {index: found for index, each in enumerate(every) if (found := _covering(each, comments)) is not None}
    valid = {row.fingerprint for row in answers.rows if row.until is None or row.until >= answers.today}
    valid |= {every[index].fingerprint for index in matched if every[index].rule == _WHERE_MADE}
    left = [each for index, each in enumerate(every) if each.fingerprint not in valid and index not in matched]
    taken = frozenset(each.fingerprint for each in every) & valid
    unused = (*_unused_rows(answers, taken), *_unused_comments(comments, set(matched.values()), answers.scopes))
    return Answered(tuple(left), len(every) - len(left), taken, unused)


_WHERE_MADE = "LNT019"


def _covering(finding: Finding, comments: Sequence[Comment]) -> Comment | None:
    return next((each for each in comments if each.covers(finding)), None)


def _unused_rows(answers: Answers, taken: Collection[str]) -> Iterator[str]:
    for row in answers.rows:
        if row.until is not None and row.until < answers.today:
            yield f"{FILE_NAME}: {row.fingerprint} was accepted until {row.until.isoformat()} ({row.reason})"
        elif row.scope in answers.scopes and row.fingerprint not in taken:
            yield f"{FILE_NAME}: {row.fingerprint} matches no finding ({row.reason})"


def _unused_comments(
    comments: Iterable[Comment], used: Collection[Comment], scopes: Collection[Scope]
) -> Iterator[str]:
    for each in comments:
        if each not in used and any(scope_of(rule) in scopes for rule in each.rules):
            yield f"{each.path}:{each.line}: ignore[{', '.join(each.rules)}] matches no finding"
