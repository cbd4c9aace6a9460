"""The two releases of a question, from what a person names."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.environments import running
from ecm_extract.registry.impact_side import Side
from ecm_extract.registry.releases import find_release, name_of, package_of_release, release_before
from ecm_extract.registry.sources import read_source
from ecm_extract.registry.tables import Release


class TwoSides(msgspec.Struct, frozen=True):
    """A release and the one that takes its place; `before` is None for the first release of a package."""

    before: Side | None
    after: Side


def two_sides(session: Session, old: str, new: str | None) -> TwoSides:
    """Return the releases of a question.

    Args:
        session: one that reads.
        old: `package@version`, or `package`.
        new: a version of the package, `package@version`, a folder, `DIR@REF` or a document; None for its newest
            release. Without a version in `old` it is compared with the release before it.

    Raises:
        InputError: one of them is not stored or cannot be read.
    """
    package, _, version = old.partition("@")
    if new is None or not _is_source(new):
        after = find_release(session, new if new and "@" in new else f"{package}@{new}" if new else package)
        before = find_release(session, old) if version else release_before(session, after)
        return TwoSides(stored_side_of(session, before) if before else None, stored_side_of(session, after))
    found = _read(new, package)
    return TwoSides(stored_side_of(session, find_release(session, old)), found)


def sides_of_environment(session: Session, environment: str, specs: Sequence[str]) -> list[TwoSides]:
    """Return releases, each with the one of its package that an environment runs.

    Raises:
        InputError: one of them is not stored.
    """
    releases = [find_release(session, spec) for spec in specs]
    runs = {each.package: each for each in running(session, environment)}
    pairs = [(runs.get(each.package), each) for each in releases]
    return [TwoSides(stored_side_of(session, old) if old else None, stored_side_of(session, new)) for old, new in pairs]


def stored_side_of(session: Session, release: Release) -> Side:
    """Return a release as a side."""
    return Side(name_of(release), package_of_release(session, release), release.commit, release.repository)


def _is_source(spec: str) -> bool:
    """Whether a word is a place rather than a version: it has a folder in it, or is one."""
    return "/" in spec or Path(spec).exists()


def _read(spec: str, package: str) -> Side:
    source = read_source(spec)
    found = next((each for each in source.packages if each.name == package), None)
    if found is None:
        names = ", ".join(sorted(each.name for each in source.packages)[:8])
        message = f"{spec} holds no package {package}"
        raise InputError(message, f"it holds {names}")
    return Side(spec, found, source.origin.commit, source.origin.repository)
