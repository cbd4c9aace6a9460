"""What is asked of lint, and what it answers."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.diff.model import RefInfo
from ecm_extract.errors import InputError
from ecm_extract.extraction_model import Options, Progress
from ecm_extract.lint.base import OF_CHANGES
from ecm_extract.lint.catalogue import catalogue
from ecm_extract.lint.completeness import Completeness
from ecm_extract.lint.workspace import Workspace
from ecm_extract.outside import RULE_ID as OUTSIDE
from ecm_extract.outside import Known


class LintRequest(msgspec.Struct, frozen=True, kw_only=True):
    """What is to be linted, and how.

    Attributes:
        path: `DIR` or `DIR@REF`.
        base: a ref; findings that it has are left out, and what changed since is told.
        base_tip: compare with the base itself, not with where the change left it.
        patch: text of a patch; only its lines count.
        select: ids of rules; empty for all.
        preview: run preview rules too.
        outside: gives what is known of packages that are not in the tree; None for nothing.
        include_tests, config, jobs: see `Options`.
    """

    path: str
    base: str | None = None
    base_tip: bool = False
    patch: str | None = None
    select: frozenset[str] = frozenset()
    preview: bool = False
    outside: Known | None = None
    include_tests: bool = False
    config: str | None = None
    jobs: int | None = None

    @property
    def folder(self) -> Path:
        """The folder of `DIR` or `DIR@REF`."""
        whole = Path(self.path)
        return whole if whole.exists() else Path(self.path.rpartition("@")[0] or self.path)

    @property
    def is_whole(self) -> bool:
        """Whether it looks at a tree as a whole; a base, a patch or a choice of rules leaves findings out."""
        return not (self.base or self.patch or self.select)

    def options(self, progress: Progress | None = None) -> Options:
        """Return how its trees are read."""
        return Options(self.include_tests, self.config, self.jobs, progress)


class Linted(msgspec.Struct, frozen=True):
    """What a run has found, where, and what it has not read; `base` is the state that it was compared with."""

    findings: Sequence[Finding]
    workspace: Workspace
    read: Completeness
    base: RefInfo | None = None


def held(request: LintRequest) -> frozenset[str]:
    """Return the preview rules that were asked for, by name or with all others, and do not run."""
    preview = frozenset(entry.rule.id for entry in catalogue() if entry.rule.tier == "preview")
    wanted = preview & request.select if request.select else preview
    return frozenset() if request.preview else wanted


def refuse_nothing(request: LintRequest) -> None:
    """Refuse a choice of rules of which none can say anything: nothing found must never look like nothing there.

    Raises:
        InputError: they tell of a change and there is no base, or are previews that were not asked for.
    """
    if request.base is None and request.select and request.select <= OF_CHANGES:
        message = f"{min(request.select)} tells what a change does, and no base is given to compare with"
        raise InputError(message, "add --base REF")
    if request.select == frozenset({OUTSIDE}) and request.outside is None:
        message = f"{OUTSIDE} tells what packages outside of the tree do not provide, and nothing tells of these"
        raise InputError(message, "add --registry or --documents")
    if request.select and held(request) == request.select:
        message = f"{min(request.select)} is a preview rule, which does not run by itself"
        raise InputError(message, "add --preview")
