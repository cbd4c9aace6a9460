"""What all rules say of one state of a tree, with what is known of packages outside of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding
from ecm_checker.hub.kinds import kinds

from ecm_extract.lint.request import LintRequest
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.outside import RULE_ID, Outside, outside_findings
from ecm_extract.requires.collect import requiring_packages


def judged(
    workspace: Workspace, request: LintRequest, told: Callable[[Outside], None] = lambda _: None
) -> list[Finding]:
    """Return what the rules that are asked for find, of the promises that the project makes.

    Args:
        workspace: the tree.
        request: what is asked.
        told: called with what is known outside of the tree, where that was asked for.
    """
    lacking = list(_lacking(workspace, request, told))
    config = workspace.config
    found = findings_of(workspace, request.select, config.severity, preview=request.preview)
    found += _untold(lacking, found)
    return [each for each in found if not config.promise or each.who in config.promise]


def _lacking(workspace: Workspace, request: LintRequest, told: Callable[[Outside], None]) -> Iterator[Finding]:
    """What packages outside of the tree must provide and do not; from here on the workspace knows these packages."""
    if request.outside is None:
        return
    inside = requiring_packages(workspace.as_side())
    outside = request.outside(inside)
    workspace.stored, workspace.released = outside.documents, outside.released
    told(outside)
    if not request.select or RULE_ID in request.select:
        yield from outside_findings(inside, outside)


def _untold(lacking: Iterable[Finding], found: Iterable[Finding]) -> list[Finding]:
    """Those of which no rule of lint tells already: a name that one line asks for in vain is one finding."""
    known = {asked for each in found for asked in _asks(each)}
    return [each for each in lacking if known.isdisjoint(_asks(each))]


def _asks(finding: Finding) -> Iterator[tuple[str, Evidence]]:
    """The kind of name, of a file its last name too, and the lines that ask for it."""
    about = finding.about
    if about is not None:
        row = kinds().get(about.kind)
        names = {about.kind, about.old.rpartition("/")[2] if row is not None and row.is_file else about.kind}
        yield from ((name, at) for name in names for at in finding.evidence)
