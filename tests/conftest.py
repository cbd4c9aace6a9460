"""Golden files: text that a person reads in review. `pytest --update-golden` writes them anew."""

from __future__ import annotations

import atexit
import gc
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import hypothesis
import pytest
from golden_files import Golden
from kept_objects import Kept
from workspaces import Workspace

from ecm_extract.cache.version import version_of

_IN_MEMORY = Path("/dev/shm")
_MAKERS_OF_KEYS = ("ecm_extract.cache.extractions.version_of", "ecm_extract.cache.blobs.version_of")

# How long one example takes says how busy the machine is; tests of bounds measure the time of the processor.
hypothesis.settings.register_profile("any machine", deadline=None)
hypothesis.settings.load_profile("any machine")


def pytest_configure() -> None:
    """Folders of tests are many and small: in memory, where there is such a place and none was asked for."""
    if "TMPDIR" not in os.environ and os.access(_IN_MEMORY, os.W_OK | os.X_OK):
        os.environ["TMPDIR"] = str(_IN_MEMORY)
        tempfile.tempdir = None
    if sys.dont_write_bytecode and "PYTHONPYCACHEPREFIX" not in os.environ:
        _keep_bytecode_aside()


def _keep_bytecode_aside() -> None:
    """Where no bytecode is to lie beside the code, processes of tests have a folder for it: they start many times."""
    folder = tempfile.mkdtemp(prefix="ecm-bytecode-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    os.environ["PYTHONPYCACHEPREFIX"] = folder
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--update-golden", action="store_true", help="write golden files anew instead of comparing")


@pytest.fixture(scope="session", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ECM_CACHE_DIR", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session", autouse=True)
def _code_that_stays() -> Iterator[None]:
    """The code does not change while it is tested, so its hash, a key of what is cached, is made once."""
    with pytest.MonkeyPatch.context() as patch:
        for name in _MAKERS_OF_KEYS:
            patch.setattr(name, cache(version_of))
        yield


@pytest.fixture(scope="session")
def _kept() -> Iterator[Kept]:
    """The tests stay, and code of ours that thaws what it froze would thaw them too."""
    kept = Kept(gc.freeze)
    with pytest.MonkeyPatch.context() as patch:
        for name in ("freeze", "unfreeze"):
            patch.setattr(gc, name, lambda: None)
        yield kept


@pytest.fixture(scope="module", autouse=True)
def _objects_that_stay(_kept: Kept) -> None:
    """What files of tests imported and remember stays for the next ones."""
    _kept.look()


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Golden:
    return Golden(update=bool(request.config.getoption("--update-golden")))


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    return Workspace(tmp_path)
