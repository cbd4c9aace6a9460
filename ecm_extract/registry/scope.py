"""Which releases a question is about: the newest of each package, or those that belong together.

What belongs together is what an environment runs, or what a file lists: `distribution.yaml` of a rosdistro (REP 143),
or a `.repos` file of vcstool.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

import msgspec
from ecm_parsers.yaml_tree import parse_yaml, plain
from sqlalchemy import Select, select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.channels import channels_from
from ecm_extract.registry.releases import newest_ids
from ecm_extract.registry.tables import Release, Running, Standing

_INCREMENT: Final = re.compile(r"-\d+$")
_MAX_BYTES: Final = 50_000_000


class Scope(msgspec.Struct, frozen=True):
    """Releases that a question is about.

    Attributes:
        shown: in words.
        ids: of the releases; None for the newest of each package.
        missing: what belongs to it and is not stored, so that nothing is known of it.
    """

    shown: str = "the newest release of each package"
    ids: tuple[int, ...] | None = None
    missing: tuple[str, ...] = ()

    def query(self) -> Select[int]:
        """Return the query of the releases' ids."""
        return newest_ids() if self.ids is None else select(Release.id).where(Release.id.in_(self.ids))


EVERYTHING: Final = Scope()


def environment_scope(session: Session, environment: str) -> Scope:
    """Return what an environment runs.

    Raises:
        InputError: nothing was recorded of it.
    """
    ids = tuple(session.scalars(select(Running.release_id).filter_by(environment=environment)))
    if not ids:
        message = f"nothing is recorded of the environment {environment}"
        raise InputError(message, f"record what it runs: `ecm-extract registry record {environment} RELEASE...`")
    return Scope(f"what {environment} runs", ids)


def channel_scope(session: Session, channel: str) -> Scope:
    """Return the newest release of each package that may run in a channel: it stands there or above.

    Raises:
        InputError: there is no such channel.
    """
    above = channels_from(channel)
    ids = tuple(session.scalars(newest_ids(Standing.channel.in_(above))))
    return Scope(f"what is in {channel} or above", ids)


def distribution_scope(session: Session, file: str) -> Scope:
    """Return what a `distribution.yaml` or a `.repos` file lists.

    Raises:
        InputError: it cannot be read, or is none of them.
    """
    found: list[int] = []
    missing: list[str] = []
    for label, query in _listed(file, _repositories(file)):
        ids = session.scalars(query).all()
        found += ids
        if not ids:
            missing.append(label)
    return Scope(f"what {file} lists", tuple(sorted(set(found))), tuple(missing))


def _repositories(file: str) -> Mapping[str, Any]:
    place = Path(file)
    try:
        data = place.read_bytes() if place.stat().st_size <= _MAX_BYTES else b""
    except OSError as error:
        message = f"cannot read {file}: {error.strerror}"
        raise InputError(message) from error
    parsed = parse_yaml(data)
    document = plain(parsed.facts[0]) if parsed.facts else None
    listed = document.get("repositories") if isinstance(document, dict) else None
    if not isinstance(listed, dict):
        message = f"{file} has no key `repositories`"
        raise InputError(message, "give a distribution.yaml of a rosdistro, or a .repos file")
    return listed


def _listed(file: str, repositories: Mapping[str, Any]) -> Iterator[tuple[str, Select[int]]]:
    for name, entry in repositories.items():
        if not isinstance(entry, dict):
            message = f"{file}: repositories.{name} is no mapping"
            raise InputError(message)
        release = entry.get("release")
        if isinstance(release, dict) and release.get("version"):
            yield from _of_distribution(name, release)
        elif entry.get("url"):
            yield _of_repos(str(entry["url"]), str(entry.get("version") or ""))


def _of_distribution(name: str, release: Mapping[str, Any]) -> Iterator[tuple[str, Select[int]]]:
    version = _INCREMENT.sub("", str(release["version"]))
    for package in release.get("packages") or (name,):
        yield f"{package}@{version}", select(Release.id).filter_by(package=str(package), version=version)


def _of_repos(url: str, version: str) -> tuple[str, Select[int]]:
    plain_url = url.removesuffix(".git")
    same = Release.repository.in_((url, plain_url, f"{plain_url}.git"))
    at = (Release.tag == version) | (Release.commit == version)
    return f"{url} {version}".strip(), select(Release.id).where(same, at)
