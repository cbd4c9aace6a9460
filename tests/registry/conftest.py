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
from sqlalchemy import Connection, make_url, text

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
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """An empty database of each kind."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'registry.sqlite'}"
    return _database(request.getfixturevalue("postgresql"))


@pytest.fixture(scope="session")
def made_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with the tables of a registry; who wants to write copies it."""
    made = tmp_path_factory.mktemp("made") / "registry.sqlite"
    Registry.create(str(made)).close()
    return made


@pytest.fixture(scope="session")
def made_database(postgresql: str) -> str:
    """The name of a database with the tables of a registry, a template of others."""
    found = _database(postgresql)
    Registry.create(found).close()
    return _name_of(found)


@pytest.fixture
def registry(request: pytest.FixtureRequest, url: str, tmp_path: Path) -> Iterator[Registry]:
    """A registry of each kind that holds nothing."""
    if url.startswith("sqlite:"):
        shutil.copy(request.getfixturevalue("made_file"), tmp_path / "registry.sqlite")
    else:
        _fill(request.getfixturevalue("postgresql"), _name_of(url), request.getfixturevalue("made_database"))
    with Registry(url) as made:
        yield made


@pytest.fixture
def small(tmp_path: Path, made_file: Path) -> Iterator[Registry]:
    """An empty registry in a file, for what does not depend on the database."""
    shutil.copy(made_file, tmp_path / "small.sqlite")
    with Registry(str(tmp_path / "small.sqlite")) as made:
        yield made


@pytest.fixture
def usual(tmp_path: Path, made_file: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty registry, `registry.sqlite` of the test's folder, that commands take without being told."""
    monkeypatch.setenv("ECM_REGISTRY", str(tmp_path / "registry.sqlite"))
    return Path(shutil.copy(made_file, tmp_path / "registry.sqlite"))


def _database(base: str) -> str:
    """The URL of an empty database of a server."""
    name = f"test{next(_NUMBERS)}"
    with _autocommit(base) as connection:
        connection.execute(text(f"CREATE DATABASE {name}"))
    return base.replace("/postgres?", f"/{name}?")


def _fill(base: str, name: str, template: str) -> None:
    with _autocommit(base) as connection:
        connection.execute(text(f"DROP DATABASE {name}"))
        connection.execute(text(f"CREATE DATABASE {name} TEMPLATE {template}"))


def _name_of(url: str) -> str:
    return str(make_url(url).database)


@contextmanager
def _autocommit(base: str) -> Iterator[Connection]:
    engine = open_engine(base).execution_options(isolation_level="AUTOCOMMIT")
    try:
        with engine.connect() as connection:
            yield connection
    finally:
        engine.dispose()
