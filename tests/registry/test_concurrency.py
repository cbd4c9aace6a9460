"""Many writers and readers at once, and writers that are killed: nothing is lost, doubled, or half there."""

from __future__ import annotations

import os
import random
import time
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from multiprocessing.connection import Connection
from multiprocessing.context import ForkServerProcess
from pathlib import Path

import msgspec
from ecm_checker.hub.package import Package
from sample import driver, packages, published
from workers import context, read, variant, write

from ecm_extract.registry.releases import list_releases
from ecm_extract.registry.store import Registry
from ecm_extract.registry.verify import verify

_EACH = 3
_KILLS = int(os.environ.get("ECM_TEST_KILLS", "10"))  # 50 take a minute


def _document(tmp_path: Path) -> tuple[Package, Path]:
    package = packages(tmp_path / "a", driver())[0]
    file = tmp_path / "driver.json"
    file.write_bytes(msgspec.json.encode(package))
    return package, file


def test_writers_and_readers_at_once(registry: Registry, url: str, tmp_path: Path) -> None:
    """Eight of each on a server, four on a file; two writers each publish the same releases."""
    package, file = _document(tmp_path)
    published(registry, (package,))
    count = 4 if url.startswith("sqlite") else 8
    with ProcessPoolExecutor(2 * count, mp_context=context()) as pool:
        writers = [pool.submit(write, url, str(file), number, _EACH) for number in range(count)]
        readers = [pool.submit(read, url, 2) for _ in range(count)]
        assert [each.result() for each in (*writers, *readers)] == [_EACH] * count + [2] * count
    wanted = {variant(package, writer, number).version for writer in range(count) for number in range(_EACH)}
    with registry.reading() as session:
        assert sorted(each.version for each in list_releases(session)) == sorted({*wanted, "1.0.0"})
        assert verify(session).problems == ()


def test_killed_writers_leave_whole_releases(registry: Registry, url: str, tmp_path: Path) -> None:
    """Whatever moment it was: what a writer said is done is there, and nothing is there in part."""
    _, file = _document(tmp_path)
    dice = random.Random(16)
    told: set[str] = set()
    running = [_start(url, file, number) for number in range(2)]
    for number in range(2, _KILLS + 2):
        writer = running.pop(0)
        told |= {f"1.{writer.number}.{each}" for each in _killed(writer, dice.uniform(0.0, 0.15))}
        if number < _KILLS:
            running.append(_start(url, file, number))
    with registry.reading() as session:
        assert verify(session).problems == ()
        assert told <= {each.version for each in list_releases(session)}
    assert len(told) >= _KILLS


class _Writer(msgspec.Struct, frozen=True):
    """A writer at work, and where it tells what is done."""

    number: int
    process: ForkServerProcess
    done: Connection


def _start(url: str, file: Path, number: int) -> _Writer:
    """Start a writer that has no release in common with another."""
    receiver, sender = context().Pipe(duplex=False)
    process = context().Process(target=write, args=(url, str(file), 2 * number, 1000, sender))
    process.start()
    sender.close()
    return _Writer(number, process, receiver)


def _killed(writer: _Writer, after: float) -> set[int]:
    """Kill a writer some time after its first release, and return what it said."""
    told = {writer.done.recv()}
    time.sleep(after)
    writer.process.kill()
    writer.process.join()
    with suppress(EOFError, OSError):
        while True:
            told.add(writer.done.recv())
    return told
