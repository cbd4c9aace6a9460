"""Questions to a registry: how `who-uses`, `impact` and `search` grow with the packages that are stored.

    python benchmarks/registry.py REGISTRY [--sizes 100,300,1000] [--every 1]

REGISTRY is a file that `registry_index.py` filled; it is copied and not changed. Of each size the packages of whole
repositories are kept, in the order of their names, with all their releases. Each question is asked once to warm up and
once to be measured, on the clock and in seconds of CPU, which other programs on the machine do not prolong.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import msgspec
from sqlalchemy import func, select, text

from ecm_extract.errors import EcmError
from ecm_extract.registry.impact import impact_of
from ecm_extract.registry.name_search import search
from ecm_extract.registry.place import registry_url
from ecm_extract.registry.questions import Asked, who_uses
from ecm_extract.registry.releases import find_release, list_releases, release_before
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.sides import stored_side_of
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import Base, Release
from ecm_extract.registry.words import words_of

_BY_RELEASE = ("standing", "dependency", "gap", "holds")
_BY_PART = ("provision", "requirement", "requirement_key")


class Taken(msgspec.Struct, frozen=True):
    """Seconds of one question, on the clock and of CPU."""

    clock: float
    cpu: float


def cut(source: Path, target: Path, size: int) -> None:
    """Keep the packages of so many repositories that there are at least `size`; rows of all others go."""
    target.write_bytes(source.read_bytes())
    with Registry(registry_url(str(target))) as registry, registry.writing() as session:
        kept: set[str] = set()
        rows = session.execute(select(Release.repository, Release.package).distinct().order_by(Release.repository))
        names: dict[str, set[str]] = {}
        for row in rows:
            names.setdefault(row.repository, set()).add(row.package)
        for packages in names.values():
            if len(kept) < size:
                kept |= packages
        gone = [each.id for each in session.scalars(select(Release)) if each.package not in kept]
        for name in _BY_RELEASE:
            table = Base.metadata.tables[name]
            session.execute(table.delete().where(table.c.release_id.in_(gone)))
        session.execute(Release.__table__.delete().where(Release.id.in_(gone)))
        for name in _BY_PART:
            session.execute(text(f"DELETE FROM {name} WHERE part_id NOT IN (SELECT part_id FROM holds)"))


def who(registry: Registry, name: str) -> None:
    with registry.reading() as session:
        try:
            who_uses(session, name, Asked(), EVERYTHING)
        except EcmError:  # a package that provides nothing
            return


def impact(registry: Registry, name: str) -> None:
    with registry.reading() as session:
        new = find_release(session, name)
        old = release_before(session, new)
        if old is not None:
            impact_of(session, stored_side_of(session, old), stored_side_of(session, new), EVERYTHING)


def find(registry: Registry, name: str) -> None:
    with registry.reading() as session:
        search(session, [" ".join(words_of(name)[:2])], EVERYTHING)


def taken(question: Callable[[], None]) -> Taken:
    question()
    clock, cpu = time.perf_counter(), time.process_time()
    question()
    return Taken(time.perf_counter() - clock, time.process_time() - cpu)


def print_times(label: str, names: Sequence[str], found: Sequence[Taken]) -> None:
    if not found:
        return
    told = []
    for kind in ("cpu", "clock"):
        times = sorted(getattr(each, kind) for each in found)
        last = times[min(len(times) - 1, int(len(times) * 0.99))]
        told.append(f"{kind}: median {statistics.median(times) * 1000:.0f} ms, p99 {last * 1000:.0f} ms")
    worst = max(zip(found, names, strict=True), key=lambda pair: pair[0].cpu)[1]
    print(f"  {label} ({len(found)}): {'; '.join(told)}; slowest {worst}", flush=True)


def report(registry: Registry, every: int) -> None:
    with registry.reading() as session:
        newest = [each.name for each in list_releases(session, newest=True)]
        releases = session.scalar(select(func.count()).select_from(Release))
        rows = session.scalar(select(func.count()).select_from(Base.metadata.tables["requirement"]))
        upgraded = [name for name in newest if release_before(session, find_release(session, name)) is not None]
    print(f"{len(newest)} packages, {releases} releases, {rows} requirement rows", flush=True)
    for label, ask, names in (
        ("who-uses, all names of a package", who, newest),
        ("impact of its newest release", impact, upgraded),
        ("search by its first two words", find, [each.partition("@")[0] for each in newest]),
    ):
        asked = names[::every]
        print_times(label, asked, [taken(partial(ask, registry, name)) for name in asked])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("registry", type=Path)
    parser.add_argument("--sizes", default="100,300,1000", help="packages at which questions are asked")
    parser.add_argument("--every", type=int, default=1, help="ask of every so-manieth package only")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for size in map(int, options.sizes.split(",")):
            target = Path(folder) / f"{size}.sqlite"
            cut(options.registry, target, size)
            with Registry(registry_url(str(target))) as registry:
                report(registry, options.every)


if __name__ == "__main__":
    main()
