"""The file of the cache: what it keeps, what it forgets, and that it never fails."""

from __future__ import annotations

import os
import sqlite3
import stat
from contextlib import closing
from multiprocessing import get_context
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from ecm_extract.cache.folder import UntrustedFolderError
from ecm_extract.cache.store import FILE_NAME, Store

KIB = b"x" * 1024


def test_what_was_put_is_known(store: Store) -> None:
    """A value comes back under its key, and under no other."""
    store.put({"a": b"1", "b": b""})
    assert store.get(["a", "b", "c"]) == {"a": b"1", "b": b""}


def test_many_keys_at_once(store: Store) -> None:
    """More keys than one query of SQLite takes."""
    values = {str(number): str(number).encode() for number in range(2500)}
    store.put(values)
    assert store.get(list(values)) == values


def test_asking_makes_nothing(store: Store) -> None:
    """A run that has nothing to keep leaves no folder behind."""
    assert store.get(["a"]) == {}
    assert store.info().entries == 0
    store.put({})
    assert not store.folder.exists()


def test_folder_is_private(store: Store) -> None:
    """Nobody else can put a contract into it, or read what somebody works on."""
    store.put({"a": b"1"})
    assert stat.S_IMODE(store.folder.stat().st_mode) == 0o700
    assert stat.S_IMODE((store.folder / FILE_NAME).stat().st_mode) == 0o600


@pytest.mark.parametrize("content", [b"", b"not a database", b"SQLite format 3\0" + b"\xff" * 5000])
def test_damaged_file_is_replaced(store: Store, content: bytes) -> None:
    """A file that is no database costs what it held, and the next run has a cache again."""
    store.folder.mkdir(0o700)
    (store.folder / FILE_NAME).write_bytes(content)
    assert store.get(["a"]) == {}
    store.put({"a": b"1"})
    store.put({"a": b"1"})
    assert store.get(["a"]) == {"a": b"1"}


@settings(max_examples=30, deadline=None)
@example(at=3825, byte=128)
@example(at=11721, byte=0)
@given(at=st.integers(0, 40_000), byte=st.integers(0, 255))
def test_damaged_bytes_give_no_wrong_value(tmp_path_factory: pytest.TempPathFactory, at: int, byte: int) -> None:
    """Whatever byte of the file changes on disk, a value is right or not known."""
    store = Store(tmp_path_factory.mktemp("cache"))
    values = {f"key{number}": bytes([number]) * 300 for number in range(80)}
    store.put(values)
    file = store.folder / FILE_NAME
    content = bytearray(file.read_bytes())
    content[at % len(content)] = byte
    file.write_bytes(content)
    found = store.get(list(values))
    assert found.items() <= values.items()
    store.put(values)


def test_value_of_another_type_is_not_known(store: Store) -> None:
    """A table that others have written into gives no text where bytes belong."""
    store.put({"a": b"1"})
    with closing(sqlite3.connect(store.folder / FILE_NAME)) as connection, connection:
        connection.execute("UPDATE entries SET value = 'text'")
    assert store.get(["a"]) == {}


def test_linked_folder_is_not_used(tmp_path: Path) -> None:
    """A link could lead to a folder that somebody else fills."""
    (tmp_path / "real").mkdir(0o700)
    (tmp_path / "link").symlink_to(tmp_path / "real")
    store = Store(tmp_path / "link")
    store.put({"a": b"1"})
    assert store.get(["a"]) == {}
    assert "link" in store.info().problem or not store.info().entries
    assert not list((tmp_path / "real").iterdir())
    with pytest.raises(UntrustedFolderError):
        store.clear()


def test_linked_file_is_not_used(store: Store, tmp_path: Path) -> None:
    """A link in the place of the file is not written through."""
    store.folder.mkdir(0o700)
    (store.folder / FILE_NAME).symlink_to(tmp_path / "elsewhere")
    store.put({"a": b"1"})
    assert store.get(["a"]) == {}
    assert not (tmp_path / "elsewhere").exists()


def test_folder_that_others_write_is_not_used(store: Store) -> None:
    """What others may have put there is nobody's fact."""
    store.folder.mkdir()
    store.folder.chmod(0o777)
    store.put({"a": b"1"})
    assert not list(store.folder.iterdir())


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_read_only_folder_keeps_nothing(store: Store) -> None:
    """A folder that cannot be written costs time only."""
    store.folder.mkdir(0o500)
    store.put({"a": b"1"})
    assert store.get(["a"]) == {}


def test_folder_below_a_file_keeps_nothing(tmp_path: Path) -> None:
    """A folder that cannot be made costs time only; also for root."""
    (tmp_path / "file").write_text("")
    store = Store(tmp_path / "file" / "cache")
    store.put({"a": b"1"})
    assert store.get(["a"]) == {}
    store.clear()


def test_locked_file_keeps_nothing(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """Who finds the file locked for long goes on without; readers do not wait at all."""
    store.put({"a": b"1"})
    monkeypatch.setattr("ecm_extract.cache.store._WAIT_S", 0.05)
    with closing(sqlite3.connect(store.folder / FILE_NAME, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        store.put({"b": b"2"})
        assert store.get(["a", "b"]) == {"a": b"1"}


def test_size_is_bounded(tmp_path: Path) -> None:
    """However much is put, the file stays within its limit."""
    store = Store(tmp_path / "cache", limit=400_000)
    for number in range(60):
        store.put({f"{number} {part}": KIB for part in range(20)})
    assert store.info().bytes <= 440_000
    assert store.get(["59 0"]) == {"59 0": KIB}
    assert store.get(["0 0"]) == {}


def test_least_recently_used_goes_first(tmp_path: Path) -> None:
    """A value that is asked for stays when older ones go."""
    now = 1.0
    store = Store(tmp_path / "cache", limit=200_000, clock=lambda: now)
    store.put({"old": KIB})
    for number in range(40):
        now += 4000.0
        assert store.get(["old"]) == {"old": KIB}
        store.put({f"{number} {part}": KIB for part in range(10)})
    assert store.get(["0 0"]) == {}


def test_value_beyond_the_limit_is_not_kept(tmp_path: Path) -> None:
    """One huge value does not push everything else out."""
    store = Store(tmp_path / "cache", limit=100_000)
    store.put({"a": b"1"})
    store.put({"b": KIB * 200})
    assert store.get(["a", "b"]) == {"a": b"1"}


def test_clear_leaves_other_files_alone(store: Store) -> None:
    """A folder that the user named may hold what is not ours."""
    store.put({"a": b"1"})
    (store.folder / "mine.txt").write_text("x")
    store.clear()
    assert [file.name for file in store.folder.iterdir()] == ["mine.txt"]
    store.clear()


def _put_many(folder: Path, name: str) -> None:
    store = Store(folder)
    for number in range(20):
        store.put({f"{name} {number} {part}": KIB for part in range(20)})


def test_processes_write_at_once(store: Store) -> None:
    """Runs beside each other all keep what they found, whoever makes the file."""
    context = get_context("fork")
    others = [context.Process(target=_put_many, args=(store.folder, str(number))) for number in range(3)]
    for other in others:
        other.start()
    for other in others:
        other.join()
    assert [other.exitcode for other in others] == [0, 0, 0]
    assert store.info().entries == 3 * 20 * 20
