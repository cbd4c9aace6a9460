"""The fixtures of the rules, apart from the repository that they are kept in."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from lint_fixtures import BAD, FIXTURES


@pytest.fixture(scope="session")
def apart(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy that nobody writes to: what lies in no repository is read without asking git."""
    return Path(shutil.copytree(FIXTURES, tmp_path_factory.mktemp("apart") / "lint"))


@pytest.fixture
def bad(tmp_path: Path) -> Path:
    """A copy of a workspace in which something is wrong."""
    return Path(shutil.copytree(BAD, tmp_path / "ws"))
