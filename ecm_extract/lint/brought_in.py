"""What a change brings in: the state before it, linted beside that of now, and the two compared."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.answers.accepted_file import accepted_file, accepted_in
from ecm_extract.answers.answered import Answers
from ecm_extract.answers.comparison import answerable, answered_comparison
from ecm_extract.diff.baseline import open_base
from ecm_extract.diff.model import Comparison, RefInfo
from ecm_extract.diff.run import Request as Comparing
from ecm_extract.diff.run import compared
from ecm_extract.diff.sides import Sides
from ecm_extract.entities.side import Side
from ecm_extract.entities.workspace import read_packages, side_of
from ecm_extract.lint.base import change_findings, new_findings
from ecm_extract.lint.judged import judged
from ecm_extract.lint.request import LintRequest
from ecm_extract.lint.workspace import Workspace
from ecm_extract.parallel_work import meanwhile
from ecm_extract.requires.collect import consumers
from ecm_extract.tree import Tree


class Before(msgspec.Struct, frozen=True):
    """What the state before the change has."""

    findings: list[Finding]
    side: Side


class Base(msgspec.Struct, frozen=True):
    """The state before the change: its tree, why it is this one, and what gives its findings and side."""

    tree: Tree
    info: RefInfo
    result: Callable[[], Before]


class BroughtIn(msgspec.Struct, frozen=True):
    """The findings that a change brings in, and the comparison that they come from."""

    findings: list[Finding]
    comparison: Comparison


def base_of(now: Tree, request: LintRequest, parsed: dict[str, Any]) -> Base:
    """Lint the base in another process, while this one lints the state of now."""
    tree, info = open_base(str(request.base), request.folder, now, request.base_tip)
    tree.folder = now.folder  # two states of one folder, wherever they lie

    def work() -> Before:
        read = read_packages(tree, request.options(), parsed)
        workspace = Workspace(tree, request.options(), read)
        return Before(judged(workspace, request), side_of(workspace.as_side()))

    return Base(tree, info, meanwhile(work, request.jobs))


def brought_in(found: list[Finding], workspace: Workspace, request: LintRequest, base: Base) -> BroughtIn:
    """Return what of the findings of now the base does not have, with the interface changes since."""
    now = workspace.as_side()
    after = side_of(now)
    before = base.result()
    tree = workspace.tree
    infos = base.info, RefInfo(request.path, tree.commit, "named")
    comparing = Comparing(base.tree, tree, request.folder, "", infos)
    comparison = compared(comparing, Sides(before.side, after, lambda: consumers(now)), {})
    comparison = _with_accepted(comparison, base, workspace, request)
    changes = change_findings(comparison, base.tree, tree)
    wanted = [each for each in changes if not request.select or each.rule in request.select]
    return BroughtIn([*new_findings(found, before.findings), *wanted], comparison)


def _with_accepted(comparison: Comparison, base: Base, workspace: Workspace, request: LintRequest) -> Comparison:
    """Note which changes are accepted: a version step need not tell of them."""
    rows = accepted_in(accepted_file(request.folder))
    answers = Answers(rows, workspace.files.read, datetime.now(tz=UTC).date(), ())
    trees = base.tree, workspace.tree
    answered, _ = answered_comparison(comparison, answerable(comparison, trees), answers)
    return msgspec.structs.replace(comparison, accepted=answered.accepted)
