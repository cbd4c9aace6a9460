"""The connection to a database: SQLite so that writers wait for each other, PostgreSQL as it comes."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, NoSuchModuleError

from ecm_extract.errors import InputError

WRITES: Final = "ecm_writes"
"""Execution option of connections that will write: SQLite then takes its lock at the begin and not in between."""
_WAIT_S: Final = 120
_DRIVERS: Final = {"postgresql": "postgresql+psycopg", "postgres": "postgresql+psycopg"}


def open_engine(url: str) -> Engine:
    """Return the engine of a database.

    Raises:
        InputError: the URL is none, or names a database that is not supported or whose driver is not installed.
    """
    found = _url(url)
    if found.get_backend_name() == "sqlite":
        return _sqlite(found)
    try:
        return create_engine(found, pool_pre_ping=True)
    except ModuleNotFoundError as error:
        message = f"{found.get_backend_name()} needs the Python package {error.name}"
        raise InputError(message, "pip install 'ecm-extract[postgresql]'") from error


def _url(text: str) -> URL:
    try:
        found = make_url(text)
        found = found.set(drivername=_DRIVERS.get(found.drivername, found.drivername))
        known = found.get_backend_name() in {"sqlite", "postgresql"}
    except (ArgumentError, NoSuchModuleError):
        known = False
    if not known:
        message = "the registry's URL names no database that is supported"
        raise InputError(message, "write sqlite:///FILE, a path, or postgresql://USER@HOST/NAME")
    return found


def _sqlite(url: URL) -> Engine:
    if url.database and url.database != ":memory:":
        try:
            Path(url.database).parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            message = f"{Path(url.database).parent} cannot be made: {error.strerror}"
            raise InputError(message, "name another file with --registry") from error
    engine = create_engine(url, connect_args={"timeout": _WAIT_S})
    event.listen(engine, "connect", _set_up)
    event.listen(engine, "begin", _begin)
    return engine


def _set_up(connection: Any, _record: Any) -> None:
    connection.isolation_level = None  # the driver's own transactions begin too late and would commit by themselves
    cursor = connection.cursor()
    for pragma in ("journal_mode = WAL", "synchronous = NORMAL", "foreign_keys = ON", "cache_size = -64000"):
        cursor.execute(f"PRAGMA {pragma}")
    cursor.close()


def _begin(connection: Connection) -> None:
    writes = connection.get_execution_options().get(WRITES)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
