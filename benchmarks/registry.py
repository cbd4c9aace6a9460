"""The registry at scale: time and size of indexing, and how `who-uses` and `impact` grow with what is stored.

    python benchmarks/registry.py CLONES [--newest 5] [--jobs 2] [--sizes 100,300,1000] [--seconds 300]

CLONES is a folder of clones. The newest releases of each are indexed until the time is up; then packages are copied
under new names (synthetic: each copy uses what the original uses) until there are as many packages as asked for.
"""

from __future__ import annotations

import argparse
import itertools
import statistics
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import nullcontext
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import msgspec
from sqlalchemy import func, select

from ecm_extract.errors import EcmError
from ecm_extract.registry.impact import impact_of
from ecm_extract.registry.index import Job, jobs_of, run
from ecm_extract.registry.publish import Origin, make_ready, publish
from ecm_extract.registry.questions import Asked, who_uses
from ecm_extract.registry.releases import find_release, list_releases, name_of, package_of_release, release_before
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.sides import stored_side_of
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import Base, Release

_QUESTIONS = 20


def _jobs(clones: Path, newest: int) -> Iterator[list[Job]]:
    for folder in sorted(clones.iterdir()):
        place = next(
            (each for each in (folder, folder / "repo") if (each / "HEAD").exists() or (each / ".git").exists()), None
        )
        try:
            found = jobs_of(place, None)[-newest:] if place is not None else []
        except EcmError as error:
            print(f"{folder.name}: {error.message}")
            continue
        if found:
            yield [msgspec.structs.replace(each, repository=folder.name) for each in found]  # mirrors have no remote


def _index(url: str, clones: Path, options: argparse.Namespace) -> None:
    begun, outcomes = time.monotonic(), []
    repositories = 0
    context: Any = nullcontext()
    if options.jobs > 1:
        context = ProcessPoolExecutor(options.jobs, mp_context=get_context("spawn"))
    with context as executor:
        for group in _groups(_jobs(clones, options.newest), 4):
            if time.monotonic() - begun > options.seconds:
                break
            repositories += len(group)
            outcomes += list(run(url, [job for jobs in group for job in jobs], _as_executor(executor)))
    took = time.monotonic() - begun
    states = Counter(each.state for each in outcomes)
    causes = Counter(_cause(why) for each in outcomes for why in each.skipped)
    releases = sum(each.releases for each in outcomes)
    print(
        f"indexed {repositories} repositories, {len(outcomes)} tags, {releases} releases in {took:.0f} s, "
        f"{options.jobs} jobs"
    )
    print(f"tags by state: {dict(states)}; skipped by cause: {dict(causes)}")


def _as_executor(found: Any) -> Executor | None:
    return found if isinstance(found, Executor) else None


def _groups(items: Iterator[list[Job]], count: int) -> Iterator[list[list[Job]]]:
    while group := list(itertools.islice(items, count)):
        yield group


def _cause(why: str) -> str:
    for part in ("other content", "no version", "no ROS package", "worker ended"):
        if part in why:
            return part
    return why[:60]


def _fill(registry: Registry, wanted: int) -> int:
    """Copy packages until there are enough; returns how many are copies."""
    with registry.reading() as session:
        real = [each.name for each in list_releases(session, newest=True) if "__copy" not in each.package]
        have = len(list_releases(session, newest=True))
        originals = [package_of_release(session, find_release(session, each)) for each in real[: max(1, wanted)]]
    for number in range(have, wanted):
        package = originals[number % len(originals)]
        copy = msgspec.structs.replace(package, name=f"{package.name}__copy{number}", provides=())
        with registry.writing() as session:
            publish(session, [make_ready(copy)], Origin(f"copy{number}"))
    return max(0, wanted - len(real))


def _questions(registry: Registry) -> tuple[list[Callable[[], None]], list[Callable[[], None]]]:
    with registry.reading() as session:
        newest = [each.name for each in list_releases(session, newest=True) if "__copy" not in each.package]
        upgraded = [name for name in newest if release_before(session, find_release(session, name)) is not None]
    step = max(1, len(newest) // _QUESTIONS)
    return (
        [lambda name=name: _who(registry, name) for name in newest[::step]],
        [lambda name=name: _impact(registry, name) for name in upgraded[:: max(1, len(upgraded) // _QUESTIONS)]],
    )


def _who(registry: Registry, name: str) -> None:
    with registry.reading() as session:
        try:
            who_uses(session, name, Asked(), EVERYTHING)
        except EcmError:  # a package that provides nothing
            return


def _impact(registry: Registry, name: str) -> None:
    with registry.reading() as session:
        new = find_release(session, name)
        old = release_before(session, new)
        assert old is not None, name_of(new)
        impact_of(session, stored_side_of(session, old), stored_side_of(session, new), EVERYTHING)


def _measured(questions: list[Callable[[], None]]) -> str:
    for question in questions:
        question()
    times = sorted(_seconds(question) for question in questions for _ in range(3))
    if not times:
        return "nothing to ask"
    last = times[min(len(times) - 1, int(len(times) * 0.99))]
    return f"median {statistics.median(times) * 1000:.0f} ms, p99 {last * 1000:.0f} ms, max {times[-1] * 1000:.0f} ms"


def _seconds(question: Callable[[], None]) -> float:
    begun = time.perf_counter()
    question()
    return time.perf_counter() - begun


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path)
    parser.add_argument("--newest", type=int, default=5, help="releases of each repository")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=300, help="for indexing")
    parser.add_argument("--sizes", default="100,300,1000", help="packages at which questions are asked")
    parser.add_argument("--registry", help="a database that is kept; default: one that is thrown away")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        url = options.registry or str(Path(folder) / "registry.sqlite")
        with Registry.create(url) as registry:
            _index(url, options.clones, options)
            for size in map(int, options.sizes.split(",")):
                _report(registry, url, size)


def _report(registry: Registry, url: str, size: int) -> None:
    copies = _fill(registry, size)
    with registry.reading() as session:
        releases = session.scalar(select(func.count()).select_from(Release))
        rows = {
            name: session.scalar(select(func.count()).select_from(each)) for name, each in Base.metadata.tables.items()
        }
    disk = sum(each.stat().st_size for each in Path(url).parent.glob(f"{Path(url).name}*")) if "://" not in url else 0
    print(
        f"{size} packages ({copies} synthetic), {releases} releases, {rows['requirement']} requirement rows, "
        f"{disk / 1e6:.0f} MB"
    )
    who, impact = _questions(registry)
    print(f"  who-uses ({len(who)} packages, all their names): {_measured(who)}")
    print(f"  impact   ({len(impact)} upgrades): {_measured(impact)}")


if __name__ == "__main__":
    main()
