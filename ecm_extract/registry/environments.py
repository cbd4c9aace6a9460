"""Environments: which release of each package a robot, a site or a simulation runs."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from sqlalchemy import delete, select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry import audit
from ecm_extract.registry.releases import find_release, name_of
from ecm_extract.registry.tables import Release, Running


class Recorded(msgspec.Struct, frozen=True):
    """A release that an environment runs, and the one of the package that it ran before; None for none."""

    release: str
    before: str | None


def record(session: Session, environment: str, specs: Sequence[str], *, whole: bool = False) -> list[Recorded]:
    """Keep what an environment runs now; packages that are not named stay as they were.

    Args:
        session: one that writes.
        environment: its name.
        specs: releases, `package@version`.
        whole: whether these are all that it runs, so that what is not named is gone.

    Raises:
        InputError: one of them is not stored.
    """
    releases = [find_release(session, spec) for spec in specs]
    _refuse_twice(releases)
    before = {each.package: name_of(each) for each in running(session, environment)}
    detail = {"releases": sorted(map(name_of, releases)), "whole": whole}
    at = audit.append(session, "record", environment, detail)
    if whole:
        session.execute(delete(Running).filter_by(environment=environment))
    for each in releases:
        session.merge(Running(environment=environment, package=each.package, release_id=each.id, since=at))
    return [Recorded(name_of(each), before.get(each.package)) for each in releases]


def running(session: Session, environment: str) -> list[Release]:
    """Return what an environment runs, by package."""
    query = select(Release).join(Running, Running.release_id == Release.id).filter_by(environment=environment)
    return list(session.scalars(query.order_by(Release.package)))


def _refuse_twice(releases: Sequence[Release]) -> None:
    seen: dict[str, Release] = {}
    for each in releases:
        other = seen.setdefault(each.package, each)
        if other.id != each.id:
            message = f"{name_of(other)} and {name_of(each)} are two releases of one package"
            raise InputError(message, "an environment runs one release of each package")
