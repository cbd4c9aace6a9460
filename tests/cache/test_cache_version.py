"""The version of what is kept follows the code."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.cache.version import EXTRACTION, FACTS, version_of


@pytest.fixture
def code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "cache_test_code"
    (folder / "below").mkdir(parents=True)
    (folder / "__init__.py").write_text("")
    (folder / "below" / "forms.toml").write_text("a = 1")
    monkeypatch.syspath_prepend(tmp_path)
    return folder


def test_version_changes_with_code_and_data(code: Path) -> None:
    """A changed, a new and a renamed file each give another version; nobody must remember to count one up."""
    versions = [version_of([code.name])]
    (code / "below" / "forms.toml").write_text("a = 2")
    versions.append(version_of([code.name]))
    (code / "new.py").write_text("")
    versions.append(version_of([code.name]))
    (code / "new.py").rename(code / "other.py")
    versions.append(version_of([code.name]))
    assert len(set(versions)) == 4
    assert all(len(version) == 40 for version in versions)


def test_version_ignores_compiled_files(code: Path) -> None:
    """Running the code does not change its version."""
    before = version_of([code.name])
    (code / "__pycache__").mkdir()
    (code / "__pycache__" / "x.pyc").write_bytes(b"x")
    assert version_of([code.name]) == before


def test_version_changes_with_libraries(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another grammar reads other facts."""
    before = version_of(FACTS)
    (tmp_path / "tree_sitter_cpp-99.0.dist-info").mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    assert version_of(FACTS) != before


def test_code_that_is_not_there_as_files_has_no_version(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What cannot be told apart is not kept."""
    (tmp_path / "cache_test_module.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    assert version_of(["cache_test_module"]) == ""
    assert version_of(["cache_test_nowhere"]) == ""


def test_versions_are_told_apart() -> None:
    """A changed rule of assembly leaves the facts of files valid."""
    assert version_of(FACTS) != version_of(EXTRACTION)
