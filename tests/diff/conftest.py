"""What a comparison of two releases of a package tells."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import package, release
from released_arm import released

from ecm_extract.cli.run import run

Files = dict[str, str | None]
Told = set[tuple[str, str, str | None, str | None]]


@pytest.fixture
def changes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> object:
    """A function from the files of two releases to the changes as the document has them."""

    def compare(old: Files, new: Files) -> list[dict[str, Any]]:
        folder = tmp_path / "repo"
        release(folder, {"arm/package.xml": package("arm"), **old}, "1.0.0")
        release(folder, new, "2.0.0")
        run(["diff", "1.0.0", "2.0.0", "--repo", str(folder), "--format", "json", "--no-cache"])
        got = capsys.readouterr()
        assert got.out, got.err
        found: list[dict[str, Any]] = json.loads(got.out)["changes"]
        return found

    return compare


@pytest.fixture
def told(changes) -> object:  # type: ignore[no-untyped-def]
    """A function from the files of two releases to what is told: kind, change, old, new."""

    def compare(old: Files, new: Files) -> Told:
        return {(each["kind"], each["change"], each["old"], each["new"]) for each in changes(old, new)}

    return compare


@pytest.fixture
def repo(tmp_path: Path) -> Path:
    """A repository with two releases of a package."""
    return released(tmp_path / "arm")
