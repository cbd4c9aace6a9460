"""The verdict: compatibility class and the version step that changes need, against the step that was taken."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

from ecm_checker.release import Change, Verdict, compatibility_class, required_bump
from ecm_checker.versions import BUMPS, Bump, bump_between

from ecm_extract.diff.model import PackageVerdict
from ecm_extract.entities.side import Side


def package_verdicts(changes: Iterable[Change], old: Side, new: Side) -> tuple[PackageVerdict, ...]:
    """Return the verdict on every package that changed, by name."""
    grouped: dict[str, list[Change]] = defaultdict(list)
    for change in changes:
        grouped[change.package].append(change)
    return tuple(_package(name, grouped[name], old, new) for name in sorted(grouped))


def _package(name: str, changes: list[Change], old: Side, new: Side) -> PackageVerdict:
    before, after = old.packages.get(name), new.packages.get(name)
    versions = before.version if before else None, after.version if after else None
    verdict = Verdict(compatibility_class(changes), required_bump(changes), bump_between(*versions))
    return PackageVerdict(name, *versions, verdict)


def repository_verdict(changes: Sequence[Change], old: Side, new: Side) -> Verdict:
    """Return the verdict on all packages; the declared step is the least that any changed package takes."""
    steps = [
        step
        for name, before in old.packages.items()
        if name in new.packages and (step := bump_between(before.version, new.packages[name].version)) is not None
    ]
    declared: Bump | None = min(steps, key=BUMPS.index) if steps else None
    return Verdict(compatibility_class(changes), required_bump(changes), declared)


def backport_line(changes: Sequence[Change]) -> str:
    """Say in one line whether the changes may go into a released distribution (REP 2004: patch and minor only)."""
    needed = required_bump(changes)
    if needed == "major":
        count = sum(change.breaking for change in changes)
        return (
            f"backport: no, {count} breaking changes; REP 2004 allows only patch and minor in a released distribution"
        )
    return f"backport: yes, {needed} only (REP 2004)"
