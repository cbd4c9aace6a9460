"""Which readers of any topic choose what they read from a file (LNT048)."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from lint_fixtures import FIXTURES, lint


@pytest.mark.parametrize(
    ("imported", "called"),
    [
        ("import yaml", "yaml.safe_load"),
        ("import yaml as y", "y.safe_load"),
        ("from yaml import safe_load", "safe_load"),
    ],
)
def test_lists(imported: str, called: str, tmp_path: Path) -> None:
    """A loader is known by its module, under whatever name it is imported."""
    folder = Path(shutil.copytree(FIXTURES / "LNT048" / "bad", tmp_path / "ws"))
    assert "LNT048" in {each.rule for each in lint(folder)}
    path = folder / "any" / "any" / "node.py"
    path.write_text(f"{imported}\n{path.read_text()}\n\ndef topics(path):\n    return {called}(open(path))\n")
    assert "LNT048" not in {each.rule for each in lint(folder)}
