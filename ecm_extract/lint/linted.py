"""One run of lint: the tree read and judged, as a whole or for what a change or a patch brings in."""

from __future__ import annotations

from typing import Any, Protocol

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding

from ecm_extract.asked import refuse_empty
from ecm_extract.diff.model import RefInfo
from ecm_extract.entities.workspace import read_packages
from ecm_extract.extraction_model import Progress
from ecm_extract.lint.brought_in import base_of, brought_in
from ecm_extract.lint.completeness import completeness_of
from ecm_extract.lint.hunks import touched_lines
from ecm_extract.lint.judged import judged
from ecm_extract.lint.request import Linted, LintRequest, refuse_nothing
from ecm_extract.lint.workspace import Workspace
from ecm_extract.outside import Outside
from ecm_extract.report.places import Places, typed_folder
from ecm_extract.report.source_lines import source_lines
from ecm_extract.tree import open_tree


class Listener(Protocol):
    """Who is told what a run stands on."""

    def base(self, info: RefInfo) -> None:
        """The state that it compares with, before the work begins."""

    def outside(self, known: Outside) -> None:
        """What is known outside of the tree."""


def linted(request: LintRequest, listener: Listener, progress: Progress | None = None) -> Linted:
    """Lint a tree.

    Args:
        request: what is asked.
        listener: is told what the run stands on.
        progress: see `Options`.

    Raises:
        InputError: the tree, the base or a document cannot be read, or no rule that was asked for can say anything.
    """
    refuse_nothing(request)
    tree = open_tree(request.path)
    parsed: dict[str, Any] = {}
    read = read_packages(tree, request.options(progress), parsed)
    refuse_empty(tree, [package.root for package in read.packages])
    base = base_of(tree, request, parsed) if request.base is not None else None
    if base is not None:
        listener.base(base.info)
    workspace = Workspace(tree, request.options(), read)
    found = judged(workspace, request, listener.outside)
    comparison = None
    if base is not None:
        change = brought_in(found, workspace, request, base)
        found, comparison = change.findings, change.comparison
    if request.patch is not None:
        found = _in_patch(found, request.patch, places_of(workspace, request))
    return Linted(found, workspace, completeness_of(workspace, comparison), base.info if base is not None else None)


def places_of(workspace: Workspace, request: LintRequest) -> Places:
    """Return how places of a workspace are written for who reads them."""
    return Places(typed_folder(request.path), line=source_lines(workspace.files.read))


def _in_patch(found: list[Finding], patch: str, places: Places) -> list[Finding]:
    """Findings with a line of the patch, which is told first: one cause may stand in many files."""
    lines = touched_lines(patch)
    kept = []
    for finding in found:
        touched = [each for each in finding.evidence if _is_touched(each, lines, places)]
        if touched:
            others = (each for each in finding.evidence if each not in touched)
            kept.append(msgspec.structs.replace(finding, evidence=(*touched, *others)))
    return kept


def _is_touched(place: Evidence, lines: dict[str, set[int]], places: Places) -> bool:
    """Paths of a patch begin at the root of the repository, or at the folder where it was made."""
    return any(place.line in lines.get(path, ()) for path in (places.from_repository(place).path, place.path))
