"""A comparison that could not read everything still has a document; a wrong command line has none."""

from __future__ import annotations

from pathlib import Path

import comparisons
import pytest
from comparisons import changes_between

DOCUMENT = (
    '{"changes": [{"kind": "parameter", "change": "removed", "package": "arm", "owner": "arm", "old": "rate",'
    ' "new": null, "breaking": true}]}'
)


@pytest.fixture
def program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """What stands for the installed command."""
    path = tmp_path / "ecm-extract"
    monkeypatch.setattr(comparisons, "command", lambda: str(path))
    return path


def _ends(program: Path, printed: str, status: int) -> None:
    program.write_text(f"#!/bin/sh\necho '{printed}' | grep .\nexit {status}\n")
    program.chmod(0o755)


@pytest.mark.parametrize("status", [0, 2])
def test_document_is_read(program: Path, tmp_path: Path, status: int) -> None:
    _ends(program, DOCUMENT, status)
    assert [each.old for each in changes_between(tmp_path, "1.0.0", "2.0.0")] == ["rate"]


@pytest.mark.parametrize("status", [2, 3])
def test_end_without_a_document_is_told(program: Path, tmp_path: Path, status: int) -> None:
    _ends(program, "", status)
    with pytest.raises(SystemExit, match=f"ended with status {status}"):
        changes_between(tmp_path, "1.0.0", "2.0.0")
