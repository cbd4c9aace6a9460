"""A distribution in the registry: the release tags of a list of clones, with time, size and what failed why.

    python benchmarks/registry_index.py LIST CLONES REGISTRY [--jobs 2 | --dask ADDRESS] [--first 20]

LIST is a file of `registry_distribution/`, CLONES the folder that holds one clone per row (`owner+name`), REGISTRY a
file or the URL of a database. A run that is killed goes on when it is begun again; the figures of time are those of
the run that prints them, those of what is stored are of all.
"""

from __future__ import annotations

import argparse
import resource
import time
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec
from sqlalchemy import func, select, text
from sqlalchemy.orm import Session

from ecm_extract.errors import EcmError
from ecm_extract.registry.cluster import Cluster
from ecm_extract.registry.index import Job, Outcome, jobs_of, run, split_known
from ecm_extract.registry.place import registry_url
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import Base, Indexed, Release
from ecm_extract.registry.workers import Processes, Workers

_CAUSES = (
    "other content",
    "declares no version",
    "holds no ROS package",
    "worker ended",
    "its tag moved",
    "of another commit",
)


class Row(msgspec.Struct, frozen=True):
    """A repository of the list; `tags` is its own pattern, where it has one."""

    name: str
    released: int
    tags: str = ""


class Listed(msgspec.Struct, frozen=True):
    """The list: of each repository the newest tags that fit the pattern; empty for all releases."""

    newest: int
    tags: str
    repositories: tuple[Row, ...]


class Spent(msgspec.Struct, frozen=True):
    """Seconds on the clock, and of all cores together."""

    clock: float
    cpu: float


def read_list(file: Path) -> Listed:
    return msgspec.convert(tomllib.loads(file.read_text("utf-8")), Listed)


def jobs_in(listed: Listed, clones: Path, first: int | None) -> list[Job]:
    """One release of each repository after the other, each repository's oldest first."""
    groups = [_jobs_of(row, listed, clones) for row in listed.repositories[:first]]
    rounds = (group[-back] for back in range(listed.newest, 0, -1) for group in groups if len(group) >= back)
    return list(rounds)


def _jobs_of(row: Row, listed: Listed, clones: Path) -> list[Job]:
    try:
        return jobs_of(clones / row.name.replace("/", "+"), row.tags or listed.tags or None)[-listed.newest :]
    except EcmError as error:
        print(f"{row.name}: {error.message}")
        return []


def spent() -> Spent:
    used = [resource.getrusage(whose) for whose in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return Spent(time.monotonic(), sum(each.ru_utime + each.ru_stime for each in used))


def index(url: str, todo: Sequence[Job], workers: Workers) -> Iterator[Outcome]:
    for number, outcome in enumerate(run(url, todo, workers), 1):
        if number % 25 == 0:
            print(f"  {number}/{len(todo)} tags", flush=True)
        yield outcome


def cause(why: str) -> str:
    return next((each for each in _CAUSES if each in why), why)


def size(session: Session, url: str) -> int:
    """Bytes on the disk."""
    if session.get_bind().dialect.name == "postgresql":
        return int(session.execute(text("SELECT pg_database_size(current_database())")).scalar_one())
    file = Path(url.removeprefix("sqlite:///"))
    return sum(each.stat().st_size for each in file.parent.glob(f"{file.name}*"))


def print_stored(session: Session, url: str) -> None:
    notes = session.execute(select(Indexed.repository, Indexed.tag, Indexed.skipped)).all()
    repositories = len({row.repository for row in notes})
    releases, packages = session.execute(
        select(func.count(), func.count(Release.package.distinct())).select_from(Release)
    ).one()
    print(
        f"stored: {repositories} repositories, {len(notes)} tags, {packages} packages, {releases} releases, "
        f"{size(session, url) / 1e6:.0f} MB"
    )
    reasons = [(row, why) for row in notes for why in msgspec.json.decode(row.skipped, type=list[str])]
    for name, count in Counter(cause(why) for _, why in reasons).most_common():
        where = sorted(
            {row.repository.removeprefix("https://github.com/") for row, why in reasons if cause(why) == name}
        )
        print(f"  left out, {name}: {count} in {len(where)} repositories ({', '.join(where[:5])})")
    for name, table in sorted(Base.metadata.tables.items()):
        print(f"  {name}: {session.scalar(select(func.count()).select_from(table))} rows")


def print_run(done: Sequence[Outcome], took: Spent, how: str) -> None:
    states = Counter(each.state for each in done)
    print(
        f"this run: {dict(states)}, {sum(each.releases for each in done)} new releases; "
        f"{took.clock:.0f} s on the clock, {took.cpu:.0f} s of CPU, {how}"
    )
    unstored = Counter(cause(why) for each in done if each.state == "skipped" for why in each.skipped)
    for why, count in unstored.most_common():
        print(f"  tags skipped: {count} x {why}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("list", type=Path)
    parser.add_argument("clones", type=Path)
    parser.add_argument("registry")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--dask", metavar="ADDRESS", help="of a scheduler, in the place of processes here")
    parser.add_argument("--newest", type=int, help="releases of each repository, in the place of what the list says")
    parser.add_argument("--first", type=int, help="so many repositories of the list")
    options = parser.parse_args()
    url = registry_url(options.registry)
    with Registry.create(url) as registry:
        listed = read_list(options.list)
        listed = msgspec.structs.replace(listed, newest=options.newest or listed.newest)
        todo, known = split_known(registry, jobs_in(listed, options.clones, options.first))
        begun = spent()
        workers = Cluster(options.dask) if options.dask else Processes(options.jobs)
        done = [*known, *index(url, todo, workers)]
        ended = spent()
        took = Spent(ended.clock - begun.clock, ended.cpu - begun.cpu)
        print_run(done, took, f"Dask at {options.dask}" if options.dask else f"{options.jobs} processes")
        with registry.reading() as session:
            print_stored(session, url)


if __name__ == "__main__":
    main()
