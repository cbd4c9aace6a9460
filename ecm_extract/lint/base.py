"""What a change brings in: findings that the base does not have, and interface changes on the lines of the change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.release import Change, fingerprint_of
from ecm_parsers.package_xml import parse

from ecm_extract.diff.break_findings import RULE as BREAK
from ecm_extract.diff.model import Comparison
from ecm_extract.diff.steps import ShortStep, short_steps
from ecm_extract.discover import discover
from ecm_extract.lint.hunks import landing_line
from ecm_extract.lint.rules.lnt019 import RULE
from ecm_extract.lint.rules.lnt030 import RULE as BUMP
from ecm_extract.tree import Tree

OF_CHANGES: Final = frozenset({RULE.id, BUMP.id, BREAK})
"""Rules that say something only where two states are compared."""


def new_findings(now: Iterable[Finding], before: Iterable[Finding]) -> list[Finding]:
    """Return the findings whose fingerprint the base does not have."""
    known = {finding.fingerprint for finding in before}
    return [finding for finding in now if finding.fingerprint not in known]


def change_findings(comparison: Comparison, old: Tree, new: Tree) -> Iterator[Finding]:
    """Yield the findings of a comparison, and each breaking change on the line that makes it."""
    yield from comparison.findings
    for change in comparison.changes:
        if change.breaking and not change.cause:
            yield where_made(change, old, new)
    for step in short_steps(comparison):
        if step.old_version != step.new_version and step.declared is not None:
            yield _bumped(step, new)


def _bumped(step: ShortStep, new: Tree) -> Finding:
    """A change that leaves the version alone is no release, so it asks for nothing; nor does what was accepted."""
    text = f"{step.package} goes from {step.old_version} to {step.new_version}, its changes need {step.required}"
    entity = Entity("package", f"{step.old_version} {step.new_version}", step.required)
    return BUMP.finding(text, entity, step.package, _manifest(step.package, new), certainty="likely")


def _manifest(package: str, tree: Tree) -> list[Evidence]:
    """The line of the version in the package.xml of a package."""
    for root in discover(tree):
        data = _read(tree, root.manifest) if root.manifest else None
        found = parse(data).facts if data is not None else None
        if found is not None and found.name == package and root.manifest:
            return [Evidence(root.manifest, found.version_line or 1)]
    return []


def where_made(change: Change, old: Tree, new: Tree) -> Finding:
    """Return a change as a finding on the line of the new tree that makes it."""
    return as_finding(change, _places(change, old, new))


def as_finding(change: Change, places: Iterable[Evidence] = ()) -> Finding:
    """Return a change as a finding on lines; it shares the fingerprint of what it breaks."""
    name = change.old or change.new or ""
    renamed = change.old and change.new and change.old != change.new
    became = f"becomes {change.new}" if renamed else change.change.replace("_", " ")
    text = f"{change.kind.replace('_', ' ')} {name} of {change.package} {became}"
    entity = Entity(change.kind, change.old or "", change.new or "")
    found = RULE.finding(text, entity, change.package, places, certainty="likely")
    return msgspec.structs.replace(found, fingerprint=fingerprint_of(change))


def _places(change: Change, old: Tree, new: Tree) -> list[Evidence]:
    """The new line, else where the old one stood in the file of now, else the file that is gone."""
    if change.evidence_new is not None:
        return [change.evidence_new]
    before = change.evidence_old
    if before is None:
        return []
    text = _read(new, before.path)
    if text is None:
        return [before]
    return [Evidence(before.path, landing_line(_read(old, before.path), text, before.line))]


def _read(tree: Tree, path: str) -> bytes | None:
    if all(entry.path != path for entry in tree.files()):
        return None
    return next((data for _, data in tree.read_many([path])), None)
