"""Whole extractions: the same bytes with the cache and without, and nothing stale."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from cache_trees import MANIFEST, document, extraction, keys, package
from git_repos import commit_all

from ecm_extract.cache.extractions import ExtractionCache
from ecm_extract.cache.recorded_tree import RecordedTree
from ecm_extract.cache.store import FILE_NAME, Store
from ecm_extract.cli.run import run
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import LocatedDiagnostic, Options
from ecm_extract.tree import open_tree

DEMO = Path(__file__).parents[2] / "fixtures" / "demo_robot"


def test_unchanged_tree_is_not_read(store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The second run takes the first one's result."""
    first = document(package(tmp_path / "one"))
    monkeypatch.setattr("ecm_extract.extraction_run.read_contracts", None)
    assert document(tmp_path / "one") == first


def test_same_bytes_with_and_without(store: Store) -> None:
    """Filling the cache, reading from it, and doing without give one and the same document."""
    without = document(DEMO, cache=False)
    assert [document(DEMO), document(DEMO)] == [without, without]
    (store.folder / FILE_NAME).unlink()
    assert document(DEMO) == without


def test_a_sparse_checkout_lacks_the_same_with_and_without(
    store: Store, tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    """What git tracks and the folder lacks is told of a tree whose reading is recorded, too."""
    folder = package(tmp_path / "one")
    commit_all(folder)
    (folder / ".git" / "info").mkdir(exist_ok=True)
    (folder / ".git" / "info" / "sparse-checkout").write_text("src\n")
    (folder / "scripts/run").unlink()
    printed = _printed(folder, "json", capfdbinary)
    assert b'"scripts/run"' in printed[0]
    assert printed[0] == printed[1] == printed[2]


@pytest.mark.parametrize("format_", ["yaml", "json"])
def test_command_prints_the_same(store: Store, capfdbinary: pytest.CaptureFixture[bytes], format_: str) -> None:
    """Manifests and document of the command line are the same, too."""
    printed = _printed(DEMO, format_, capfdbinary)
    assert printed[0] == printed[1] == printed[2]


def test_check_decides_the_same(store: Store, capsys: pytest.CaptureFixture[str]) -> None:
    """A contract out of the cache is checked like one that was just read."""
    printed = []
    for switch in (["--no-cache"], [], []):
        run(["check", str(DEMO), "--format", "json", *switch])
        printed.append(capsys.readouterr())
    assert printed[0] == printed[1] == printed[2]


def _printed(folder: Path, format_: str, capfdbinary: pytest.CaptureFixture[bytes]) -> list[bytes]:
    """What the command line writes without the cache, filling it, and reading from it."""
    found = []
    for switch in (["--no-cache"], [], []):
        assert run(["extract", str(folder), "--format", format_, "-o", "-", "-q", *switch]) == 0
        found.append(capfdbinary.readouterr().out)
    return found


def _edit(folder: Path) -> None:
    package(folder, "other")


def _add_source(folder: Path) -> None:
    shutil.copy(folder / "src/a.cpp", folder / "src/b.cpp")


def _add_configuration(folder: Path) -> None:
    (folder / "ecm.toml").write_text('[extract]\nexclude = ["src/*"]\n')


def _add_overlay(folder: Path) -> None:
    (folder / "ecm.yaml").write_text("modules: {}\n")


def _remove(folder: Path) -> None:
    (folder / "src/a.cpp").unlink()


def _add_bad_link(folder: Path) -> None:
    (folder / "src/c.cpp").symlink_to("/etc/hostname")


def _edit_manifest(folder: Path) -> None:
    (folder / "package.xml").write_text(MANIFEST.replace("1.0.0", "1.0.1"))


@pytest.mark.parametrize(
    "change", [_edit, _add_source, _add_configuration, _add_overlay, _remove, _add_bad_link, _edit_manifest]
)
def test_changed_tree_is_read(store: Store, tmp_path: Path, change: Callable[[Path], None]) -> None:
    """Every kind of change is seen; going back is, too."""
    folder = package(tmp_path / "one")
    before = document(folder)
    change(folder)
    after = document(folder, cache=False)
    assert document(folder) == after
    assert document(folder) == after
    shutil.rmtree(folder)
    assert document(package(folder)) == before


def test_options_are_told_apart(store: Store, tmp_path: Path) -> None:
    """Another configuration or label is another extraction."""
    folder = package(tmp_path / "one")
    config = tmp_path / "c.toml"
    config.write_text("")
    cases = [Options(jobs=1), Options(jobs=1, include_tests=True), Options(jobs=1, config=str(config))]
    for options in cases:
        extract(open_tree(folder), options)
    config.write_text("[extract]\ninclude_tests = true\n")
    extract(open_tree(folder), cases[-1])
    assert keys(store).count("extraction") == 4


def test_other_version_is_not_read(store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What another version of the program has extracted is not taken."""
    tree = open_tree(package(tmp_path / "one"))
    extraction(tmp_path / "one")
    assert ExtractionCache(tree, Options(jobs=1)).known() is not None
    monkeypatch.setattr("ecm_extract.cache.extractions.version_of", lambda packages: "other")
    assert ExtractionCache(tree, Options(jobs=1)).known() is None


def test_cut_extraction_is_not_kept(store: Store, tmp_path: Path) -> None:
    """What a time limit or a lost process has cut, another run may have whole."""
    found = extraction(package(tmp_path / "one"), cache=False)
    cache = ExtractionCache(open_tree(tmp_path / "one"), Options(jobs=1))
    for code in ("cpp-too-slow", "worker-lost"):
        cut = type(found)(found.path, found.commit, found.packages, (LocatedDiagnostic("error", code, "a", 0, "m"),))
        cache.add(cut, {})
    assert keys(store) == []


def test_file_that_changes_meanwhile_is_not_kept(store: Store, tmp_path: Path) -> None:
    """An extraction of two states of a file is that of neither."""
    folder = package(tmp_path / "one")
    tree = RecordedTree(open_tree(folder))
    tree.read("src/a.cpp")
    assert tree.stable
    package(folder, "other")
    dict(tree.read_many(["src/a.cpp"]))
    assert not tree.stable


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read anything")
def test_unreadable_file_is_not_kept(tmp_path: Path) -> None:
    """A file that cannot be read now may be readable the next time."""
    folder = package(tmp_path / "one")
    (folder / "src/a.cpp").chmod(0)
    tree = RecordedTree(open_tree(folder))
    assert dict(tree.read_many(["src/a.cpp"])) == {}
    assert not tree.stable


def test_file_that_vanishes_is_not_kept(tmp_path: Path) -> None:
    """A file that was listed and is gone makes no extraction that could come back."""
    folder = package(tmp_path / "one")
    tree = RecordedTree(open_tree(folder))
    tree.files()
    (folder / "src/a.cpp").unlink()
    assert dict(tree.read_many(["src/a.cpp", "nowhere"])) == {}
    assert not tree.stable


def test_ref_and_clone_share_facts(store: Store, tmp_path: Path) -> None:
    """A ref and a folder of the same content parse it once."""
    folder = package(tmp_path / "one")
    commit_all(folder)
    extraction(folder)
    before = keys(store).count("facts")
    extract(open_tree(folder, "HEAD"), Options(jobs=1))
    assert keys(store).count("facts") == before


def test_damaged_cache_costs_no_result(store: Store, tmp_path: Path) -> None:
    """An extraction is the same when the cache holds nonsense, and no diagnostic tells of it."""
    without = document(package(tmp_path / "one"), cache=False)
    store.folder.mkdir(0o700)
    (store.folder / FILE_NAME).write_bytes(b"nonsense" * 1000)
    assert document(tmp_path / "one") == without
    assert document(tmp_path / "one") == without
