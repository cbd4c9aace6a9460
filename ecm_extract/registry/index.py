"""Indexing: the release tags of many repositories become releases, by processes here or by workers elsewhere.

A tag is one job and one transaction. What is done is remembered with it, so that a run that was killed goes on where
it stopped, and a tag that moved since is told and not read again.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fnmatch import fnmatchcase
from functools import partial
from pathlib import Path
from typing import Literal

import msgspec
from sqlalchemy import select

from ecm_extract.errors import EcmError
from ecm_extract.registry import audit
from ecm_extract.registry.publish import Origin, make_ready, publish
from ecm_extract.registry.sources import packages_of
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import Indexed
from ecm_extract.registry.workers import Workers
from ecm_extract.tree import ReleaseTag, open_ref, open_repo, release_tags
from ecm_extract.tree.remote import repository_name

State = Literal["indexed", "known", "skipped"]


class Job(msgspec.Struct, frozen=True):
    """One tag of a repository: its folder, the name that it is known by, its tag and commit."""

    folder: str
    repository: str
    tag: str
    commit: str


class Outcome(msgspec.Struct, frozen=True):
    """What came of a tag.

    Attributes:
        state: `known` when it was indexed before; `skipped` when nothing of it could be stored.
        releases: how many are new.
        skipped: why packages, or the tag as a whole, were left out.
    """

    repository: str
    tag: str
    state: State
    releases: int = 0
    skipped: tuple[str, ...] = ()


def jobs_of(folder: Path, pattern: str | None) -> list[Job]:
    """Return the jobs of a clone, oldest release first.

    Args:
        folder: a clone, with or without a work tree.
        pattern: of tags, as in a shell; None for all that name a version and no pre-release.

    Raises:
        TreeError: it is no repository.
    """
    repo = open_repo(folder)
    name = repository_name(repo)
    tags = release_tags(repo)
    return [Job(str(folder), name, tag.name, tag.commit) for tag in tags if _is_wanted(tag, pattern)]


def _is_wanted(tag: ReleaseTag, pattern: str | None) -> bool:
    return not tag.prerelease if pattern is None else fnmatchcase(tag.name, pattern)


def split_known(registry: Registry, jobs: Iterable[Job]) -> tuple[list[Job], list[Outcome]]:
    """Return the jobs that are still to do, and the outcomes of those that were done before."""
    with registry.reading() as session:
        rows = session.execute(select(Indexed.repository, Indexed.tag, Indexed.commit))
        done = {(row.repository, row.tag): row.commit for row in rows}
    todo, known = [], []
    for job in jobs:
        commit = done.get((job.repository, job.tag))
        if commit is None:
            todo.append(job)
        else:
            known.append(_known(job, commit))
    return todo, known


def _known(job: Job, commit: str) -> Outcome:
    if commit == job.commit:
        return Outcome(job.repository, job.tag, "known")
    why = (
        f"its tag moved from {commit[:12]} to {job.commit[:12]}, or another clone is called {job.repository}; "
        "what is stored never changes"
    )
    return Outcome(job.repository, job.tag, "skipped", 0, (why,))


def run(url: str, jobs: Sequence[Job], workers: Workers) -> Iterator[Outcome]:
    """Do jobs and yield their outcomes as they come.

    Args:
        url: of the registry; each worker opens it.
        jobs: in the order in which they are begun.
        workers: who does them.
    """
    for done in workers.do(partial(index_tag, url), jobs):
        yield done.result or _unread(done.job, done.error)


def _unread(job: Job, error: str) -> Outcome:
    """The next run does it again."""
    return Outcome(job.repository, job.tag, "skipped", 0, (f"its worker ended: {error}",))


def index_tag(url: str, job: Job) -> Outcome:
    """Read a tag and store its packages, in one transaction with the note that it is done."""
    try:
        packages = packages_of(open_ref(Path(job.folder), job.commit), 1)
        ready = [make_ready(each) for each in packages]
        with Registry(url) as registry, registry.writing() as session:
            held = session.get(Indexed, (job.repository, job.tag))
            if held is not None:  # another process did it meanwhile, or another clone has the name
                return _known(job, held.commit)
            origin = Origin(job.repository, job.tag, job.commit)
            done = publish(session, ready, origin)
            new = sum(each.state == "published" for each in done)
            why = tuple(f"{each.release}: {each.reason}" for each in done if each.state == "refused")
            why = why if packages else ("it holds no ROS package",)
            at = audit.append(session, "index", f"{job.repository} {job.tag}", {"commit": job.commit, "releases": new})
            note = msgspec.json.encode(why).decode()
            session.add(Indexed(**_row(job), releases=new, skipped=note, at=at))
    except EcmError as error:  # a tag that cannot be read is not a reason to stop
        return Outcome(job.repository, job.tag, "skipped", 0, (error.message,))
    return Outcome(job.repository, job.tag, "indexed" if packages else "skipped", new, why)


def _row(job: Job) -> dict[str, str]:
    return {"repository": job.repository, "tag": job.tag, "commit": job.commit}
