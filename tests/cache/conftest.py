"""A cache of its own for each test."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.cache.store import Store


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Store:
    folder = tmp_path / "cache"
    monkeypatch.setenv("ECM_CACHE_DIR", str(folder))
    return Store(folder)
