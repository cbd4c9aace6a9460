"""Versions and ranges of versions."""

from __future__ import annotations

import re
from typing import Final, Literal

from packaging.specifiers import InvalidSpecifier, SpecifierSet
from packaging.version import InvalidVersion, Version

Bump = Literal["none", "patch", "minor", "major"]

BUMPS: Final[tuple[Bump, ...]] = ("none", "patch", "minor", "major")
MAX_LENGTH: Final = 200
"""Longest text that is read as a version or a range; numbers of thousands of digits cannot be read at all."""
_ANY: Final = frozenset({"", "*", "any", "True"})
_SPACE: Final = re.compile(r"(?<=[\w*])\s+(?=[<>=!~])")


def version(text: str | None) -> Version | None:
    """The version of a text; None when it is none."""
    try:
        return Version(text or "") if len(text or "") <= MAX_LENGTH else None
    except InvalidVersion:
        return None


def in_range(installed: str, wanted: str) -> bool | None:
    """Whether a version is in a range (`>=2.1,<3.0`, `>=2.1 <3.0`, `*`); None when one of them cannot be read.

    A bare version means that version.
    """
    if wanted.strip() in _ANY:
        return True
    found = version(installed)
    if len(wanted) > MAX_LENGTH:
        return None
    text = _SPACE.sub(",", wanted.strip())
    try:
        ranges = SpecifierSet(text if text[0] in "<>=!~" else f"=={text}", prereleases=True)
    except InvalidSpecifier:
        return None
    return None if found is None else found in ranges


def bump_between(old: str | None, new: str | None) -> Bump | None:
    """The step between two versions; `none` for the same or an older one, None when one cannot be read."""
    before, after = version(old), version(new)
    if before is None or after is None:
        return None
    if after <= before:
        return "none"
    if after.major != before.major:
        return "major"
    return "minor" if after.minor != before.minor else "patch"
