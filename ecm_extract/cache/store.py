"""Values by key in one SQLite file of bounded size, which any number of processes may use at once.

Nothing here fails: a file that is locked, full, read-only or damaged knows nothing and keeps nothing, and a damaged
one is deleted. No connection outlives a call, so none is ever open across a fork.
"""

from __future__ import annotations

import sqlite3
import time
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ecm_extract.cache.folder import UntrustedFolderError, require_trusted

FILE_NAME: Final = "cache-1.sqlite"
"""The number is that of the table below: another layout is another file."""

MAX_BYTES: Final = 500_000_000

_TABLE: Final = """
CREATE TABLE IF NOT EXISTS entries (
    key TEXT PRIMARY KEY, used REAL NOT NULL, size INTEGER NOT NULL, value BLOB NOT NULL
);
CREATE INDEX IF NOT EXISTS entries_by_use ON entries (used, size);
"""
_SELECT: Final = """
SELECT key, used, value FROM entries WHERE typeof(used) = 'real' AND typeof(value) = 'blob' AND key IN"""
_WAIT_S: Final = 2.0
_STALE_S: Final = 3600.0
_KEYS_A_QUERY: Final = 500
_KEPT_SHARE: Final = 0.8
_CHECK_BYTES: Final = 4
_UNUSABLE: Final = (OSError, sqlite3.Error, UntrustedFolderError, UnicodeDecodeError)
"""What a file that cannot be used gives; where its damage lies in a name, SQLite's words about it are no text."""


@dataclass(frozen=True)
class Info:
    """What a cache holds.

    Attributes:
        folder: where it lies. limit: of its size, in bytes.
        entries: how many. bytes: how large the file is.
        problem: why it cannot be used; empty when it can.
    """

    folder: Path
    limit: int
    entries: int = 0
    bytes: int = 0
    problem: str = ""


@dataclass(frozen=True)
class Store:
    """Values by key below a folder.

    Attributes:
        folder: made when something is put. limit: bytes that the file may have; least recently used values go.
        clock: seconds.
    """

    folder: Path
    limit: int = MAX_BYTES
    clock: Callable[[], float] = time.time

    def get(self, keys: Sequence[str]) -> dict[str, bytes]:
        """Values that are known; one that was damaged on disk is not."""
        found: dict[str, bytes] = {}
        with suppress(*_UNUSABLE), self._connection(create=False) as connection:
            stale: list[str] = []
            for key, used, value in _rows(connection, keys):
                if value[:_CHECK_BYTES] == _check(key, value[_CHECK_BYTES:]):
                    found[key] = value[_CHECK_BYTES:]
                    if abs(self.clock() - used) > _STALE_S:
                        stale.append(key)
            self._touch(connection, stale)
        return found

    def put(self, values: Mapping[str, bytes]) -> None:
        """Keep values, all of them or none."""
        now = self.clock()
        rows = [(key, now, len(value), _check(key, value) + value) for key, value in values.items()]
        incoming = sum(size for _, _, size, _ in rows)
        if not rows or incoming > self.limit * _KEPT_SHARE:
            return
        with (
            suppress(*_UNUSABLE),
            self._connection(create=True) as connection,
            _transaction(connection),
        ):
            _make_room(connection, self.limit - incoming, self.limit)
            connection.executemany("INSERT OR REPLACE INTO entries VALUES (?, ?, ?, ?)", rows)

    def info(self) -> Info:
        """What the file holds now."""
        file = self.folder / FILE_NAME
        try:
            if not file.exists():
                return Info(self.folder, self.limit)
            with self._connection(create=False) as connection:
                (entries,) = connection.execute("SELECT count(*) FROM entries").fetchone()
                return Info(self.folder, self.limit, entries, file.stat().st_size)
        except _UNUSABLE as error:
            return Info(self.folder, self.limit, problem=str(error))

    def clear(self) -> None:
        """Delete the file; other files in the folder are left alone.

        Raises:
            OSError: it cannot be deleted.
            UntrustedFolderError: the folder is not the user's own.
        """
        if self.folder.is_symlink() or self.folder.exists():
            require_trusted(self.folder, create=False)
            self._delete()

    def _delete(self) -> None:
        for suffix in ("", "-wal", "-shm"):
            (self.folder / f"{FILE_NAME}{suffix}").unlink(missing_ok=True)

    @contextmanager
    def _connection(self, *, create: bool) -> Iterator[sqlite3.Connection]:
        require_trusted(self.folder, create=create)
        file = self.folder / FILE_NAME
        if file.is_symlink() or not (create or file.exists()):
            message = "the file is a symbolic link" if file.is_symlink() else "there is none"
            raise UntrustedFolderError(message)
        try:
            with closing(sqlite3.connect(file, timeout=_WAIT_S, isolation_level=None)) as connection:
                if create:
                    file.chmod(0o600)
                    _set_up(connection)
                yield connection
        except sqlite3.OperationalError:
            raise
        except (sqlite3.DatabaseError, UnicodeDecodeError):  # names in a damaged schema need not be text
            self._delete()
            raise

    def _touch(self, connection: sqlite3.Connection, keys: Sequence[str]) -> None:
        if keys:
            with _transaction(connection):
                now = self.clock()
                connection.executemany("UPDATE entries SET used = ? WHERE key = ?", [(now, key) for key in keys])


def _set_up(connection: sqlite3.Connection) -> None:
    """Writers do not stop readers; a loss of power may cost the cache, so nobody waits for the disk."""
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = OFF")
    connection.executescript(_TABLE)


@contextmanager
def _transaction(connection: sqlite3.Connection) -> Iterator[None]:
    connection.execute("BEGIN IMMEDIATE")
    try:
        yield
    except BaseException:
        with suppress(sqlite3.Error):
            connection.execute("ROLLBACK")
        raise
    connection.execute("COMMIT")


def _rows(connection: sqlite3.Connection, keys: Sequence[str]) -> Iterator[tuple[str, float, bytes]]:
    for start in range(0, len(keys), _KEYS_A_QUERY):
        part = keys[start : start + _KEYS_A_QUERY]
        marks = ",".join("?" * len(part))
        for key, used, value in connection.execute(f"{_SELECT} ({marks})", part):
            if isinstance(key, str) and isinstance(used, int | float) and isinstance(value, bytes):
                yield key, used, value  # of others the disk has lost something


def _make_room(connection: sqlite3.Connection, room: int, limit: int) -> None:
    """Delete what was not used for longest when more than `room` is taken, well below that, so not every time."""
    pages, free, size = (
        connection.execute(f"PRAGMA {name}").fetchone()[0] for name in ("page_count", "freelist_count", "page_size")
    )
    excess = (pages - free) * size - room
    if excess <= 0:
        return
    excess += int(limit * (1 - _KEPT_SHARE))
    gone: list[tuple[int]] = []
    for row, bytes_ in connection.execute("SELECT rowid, size FROM entries ORDER BY used, rowid"):
        if excess <= 0:
            break
        excess -= bytes_
        gone.append((row,))
    connection.executemany("DELETE FROM entries WHERE rowid = ?", gone)


def _check(key: str, value: bytes) -> bytes:
    return zlib.crc32(value, zlib.crc32(key.encode())).to_bytes(_CHECK_BYTES, "big")
