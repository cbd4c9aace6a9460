"""Registries for the tests: one file, or a schema of a server."""

from __future__ import annotations

import itertools
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from postgres import NotThereError, server
from sqlalchemy import Connection, text

from ecm_extract.registry.engine import open_engine
from ecm_extract.registry.store import Registry

_NUMBERS = itertools.count()


@pytest.fixture(scope="session")
def postgresql() -> Iterator[str]:
    """The URL of a server; skips where none starts."""
    folder = Path(tempfile.mkdtemp(prefix="ecm-pg-"))  # a socket's path may be 107 characters long
    try:
        with server(folder) as url:
            yield url
    except NotThereError as error:
        pytest.skip(str(error))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """An empty database of each kind."""
    if request.param == "sqlite":
        yield f"sqlite:///{tmp_path / 'registry.sqlite'}"
        return
    base, name = request.getfixturevalue("postgresql"), f"test{next(_NUMBERS)}"
    with _autocommit(base) as connection:
        connection.execute(text(f"CREATE DATABASE {name}"))
    yield base.replace("/postgres?", f"/{name}?")


@pytest.fixture
def registry(url: str) -> Iterator[Registry]:
    """An empty registry of each kind."""
    with Registry.create(url) as made:
        yield made


@pytest.fixture
def small(tmp_path: Path) -> Iterator[Registry]:
    """An empty registry in a file, for what does not depend on the database."""
    with Registry.create(str(tmp_path / "small.sqlite")) as made:
        yield made


@contextmanager
def _autocommit(base: str) -> Iterator[Connection]:
    engine = open_engine(base).execution_options(isolation_level="AUTOCOMMIT")
    try:
        with engine.connect() as connection:
            yield connection
    finally:
        engine.dispose()
