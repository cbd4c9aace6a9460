"""Texts under version control that a person reads in review."""

from __future__ import annotations

import difflib
from pathlib import Path

import pytest

GOLDEN = Path(__file__).parent / "golden"


class Golden:
    """Compares text with a file under version control."""

    def __init__(self, update: bool) -> None:
        self._update = update

    def __call__(self, name: str, text: str) -> None:
        """Fail with a diff unless `text` equals tests/golden/NAME."""
        self.check(GOLDEN / name, text)

    def check(self, path: Path, text: str) -> None:
        """Fail with a diff unless `text` equals the file at `path`; write the file when asked to update."""
        before = path.read_text("utf-8") if path.is_file() else None
        if before == text:
            return
        if self._update:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
            return
        diff = difflib.unified_diff(
            (before or "").splitlines(), text.splitlines(), f"{path.name} (golden)", f"{path.name} (now)", lineterm=""
        )
        diff = list(diff) or [f"{path.name} is not there, or its lines end otherwise"]
        pytest.fail("\n".join([*diff, "if this is meant: pytest --update-golden"]), pytrace=False)
