"""Whether a release takes the version step that its changes need, and which version would.

Below 1.0.0 nothing is promised between minor versions, so a step there counts as the next higher one
(Semantic Versioning 2.0.0, item 4, in the reading that Cargo made common).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import msgspec
from ecm_checker.release import Change, fingerprint_of, required_bump
from ecm_checker.versions import BUMPS, Bump, version

from ecm_extract.diff.model import Comparison, PackageVerdict


class ShortStep(msgspec.Struct, frozen=True):
    """A package whose version step is less than its changes need.

    Attributes:
        package: that is released. old_version, new_version: None where it is not there or cannot be read.
        required: what its changes need that nobody has accepted. declared: the step that it takes, None where unknown.
        enough: least version that would do; None where the old one cannot be read.
    """

    package: str
    old_version: str | None
    new_version: str | None
    required: Bump
    declared: Bump | None
    enough: str | None


def short_steps(comparison: Comparison) -> tuple[ShortStep, ...]:
    """Return the packages that take too small a step, by name; a package that is new promises nothing yet."""
    open_changes: dict[str, list[Change]] = defaultdict(list)
    for change in comparison.changes:
        if fingerprint_of(change) not in comparison.accepted:
            open_changes[change.package].append(change)
    return tuple(_short(comparison, open_changes))


def _short(comparison: Comparison, open_changes: dict[str, list[Change]]) -> Iterator[ShortStep]:
    for entry in comparison.packages:
        required = required_bump(open_changes[entry.package])
        declared = _declared(entry, comparison)
        if entry.old_version is not None and not is_enough(declared, required, entry.old_version):
            enough = version_for(entry.old_version, required)
            yield ShortStep(entry.package, entry.old_version, entry.new_version, required, declared, enough)


def _declared(entry: PackageVerdict, comparison: Comparison) -> Bump | None:
    """A package that is gone has no version: the step of those that stay tells of it."""
    return comparison.verdict.declared_bump if entry.new_version is None else entry.verdict.declared_bump


def is_enough(declared: Bump | None, required: Bump, old_version: str | None) -> bool:
    """Tell whether a version step is what changes need; an unknown step is not."""
    if required == "none":
        return True
    if declared is None or declared == "none":
        return False
    return BUMPS.index(declared) + _is_initial(old_version) >= BUMPS.index(required)


def version_for(old_version: str, required: Bump) -> str | None:
    """Return the least version that takes a step from an old one; None where that cannot be read."""
    before = version(old_version)
    if before is None or required == "none":
        return None
    step = BUMPS[max(BUMPS.index(required) - _is_initial(old_version), 1)]
    if step == "major":
        return f"{before.major + 1}.0.0"
    return (
        f"{before.major}.{before.minor + 1}.0"
        if step == "minor"
        else f"{before.major}.{before.minor}.{before.micro + 1}"
    )


def _is_initial(old_version: str | None) -> bool:
    before = version(old_version)
    return before is not None and before.major == 0
