"""The verdict: compatibility class and the version step that changes need, against the step that was taken.

What was not read is part of it: no class that is milder than `breaking` is known of a release that is not whole.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

from ecm_checker.release import Change, compatibility_class, required_bump
from ecm_checker.versions import BUMPS, Bump, bump_between

from ecm_extract.diff.model import Comparison, PackageVerdict, Verdict
from ecm_extract.diff.unread import UnreadPart
from ecm_extract.entities.side import PackageInfo, Side


def package_verdicts(
    changes: Iterable[Change], old: Side, new: Side, unread: Sequence[UnreadPart]
) -> tuple[PackageVerdict, ...]:
    """Return the verdict on every package that changed or was not read as a whole, by name."""
    grouped: dict[str, list[Change]] = defaultdict(list)
    for change in changes:
        grouped[change.package].append(change)
    gaps = [part.path for part in unread if part.limits]
    cut = {name for side in (old, new) for name, each in side.packages.items() if _is_cut(each, gaps)}
    return tuple(_package(name, grouped[name], (old, new), name not in cut) for name in sorted({*grouped, *cut}))


def _is_cut(package: PackageInfo, gaps: Sequence[str]) -> bool:
    folder = f"{package.path}/" if package.path else ""
    return any(path.startswith(folder) for path in gaps)


def _package(name: str, changes: list[Change], sides: tuple[Side, Side], complete: bool) -> PackageVerdict:
    before, after = (side.packages.get(name) for side in sides)
    versions = before.version if before else None, after.version if after else None
    return PackageVerdict(name, *versions, _verdict(changes, bump_between(*versions), complete))


def repository_verdict(changes: Sequence[Change], old: Side, new: Side, unread: Iterable[UnreadPart]) -> Verdict:
    """Return the verdict on all packages; the declared step is the least that any changed package takes."""
    steps = [
        step
        for name, before in old.packages.items()
        if name in new.packages and (step := bump_between(before.version, new.packages[name].version)) is not None
    ]
    declared: Bump | None = min(steps, key=BUMPS.index) if steps else None
    return _verdict(changes, declared, not any(part.limits for part in unread))


def _verdict(changes: Sequence[Change], declared: Bump | None, complete: bool) -> Verdict:
    known = compatibility_class(changes)
    seen = known if complete or known == "breaking" else "unknown"
    return Verdict(seen, required_bump(changes), declared, complete)


def needed(verdict: Verdict) -> str:
    """The step that a release needs, in words; of one that is not whole only the least step is known."""
    if verdict.complete or verdict.required_bump == "major":
        return verdict.required_bump
    return "unknown" if verdict.required_bump == "none" else f"at least {verdict.required_bump}"


def backport_line(comparison: Comparison, changes: Sequence[Change]) -> str:
    """Say in one line whether changes may go into a released distribution (REP 2004: patch and minor only).

    Args:
        comparison: that they are of.
        changes: those that nobody has accepted.
    """
    required = required_bump(changes)
    if required == "major":
        count = sum(change.breaking for change in changes)
        told = f"{count} breaking change{'' if count == 1 else 's'}"
        return f"backport: no, {told}; REP 2004 allows only patch and minor in a released distribution"
    if not comparison.verdict.complete:
        return f"backport: unknown, {required} in what could be read (REP 2004)"
    needed = "nothing that needs a step" if required == "none" else f"{required} only"
    return f"backport: yes, {needed} (REP 2004)"
