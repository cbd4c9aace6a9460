"""A comparison without what a person has answered: changes, and the uses that they break."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.release import Change

from ecm_extract.answers.answered import Answered, Answers, answered
from ecm_extract.diff.model import Comparison
from ecm_extract.lint.base import as_finding, where_made
from ecm_extract.tree import Tree

_MARK = b"ecm:"


def answerable(comparison: Comparison, trees: tuple[Tree, Tree] | None) -> list[Finding]:
    """Return everything of a comparison that can be answered: the uses that break, and each change as a finding.

    A change has a place only where its file holds a comment: to find it in thousands of files takes long. Of stored
    documents there are no files; `trees` is None then.
    """
    if trees is None:
        return [*comparison.findings, *map(as_finding, comparison.changes)]
    old, new = trees
    marked = _marked(comparison.changes, new)
    made = [
        where_made(change, old, new) if _path(change) in marked else as_finding(change) for change in comparison.changes
    ]
    return [*comparison.findings, *made]


def answered_comparison(
    comparison: Comparison, found: Iterable[Finding], answers: Answers
) -> tuple[Comparison, Answered]:
    """Take out what was answered.

    Args:
        comparison: of two trees.
        found: what of it can be answered, see `answerable`.
        answers: of which `read` gives files of the new tree.
    """
    every = list(found)
    result = answered(every, answers)
    left = frozenset(result.findings)
    accepted = {each.fingerprint for each in every} - {each.fingerprint for each in result.findings}
    kept = tuple(each for each in comparison.findings if each in left)
    return msgspec.structs.replace(comparison, findings=kept, accepted=frozenset(accepted)), result


def _marked(changes: Iterable[Change], tree: Tree) -> Mapping[str, bytes]:
    """Files of changes that hold a comment."""
    listed = {entry.path for entry in tree.files()}
    wanted = sorted({_path(change) for change in changes} & listed)
    return {path: data for path, data in tree.read_many(wanted) if _MARK in data}


def _path(change: Change) -> str:
    at = change.evidence_new or change.evidence_old
    return at.path if at is not None else ""
