"""Manifests in a folder."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from extractions import CMD_VEL, demo, make_extraction, make_module, make_package

from ecm_extract.errors import InputError
from ecm_extract.report.folder import write_manifests


def test_a_module_has_a_file(tmp_path: Path) -> None:
    """`<package>/<module_id>.ecm.yaml`."""
    written = write_manifests(demo(), tmp_path / "out")
    assert [str(path.relative_to(tmp_path)) for path in written] == ["out/base/ecm.base.driver.ecm.yaml"]
    assert all(path.is_file() for path in written)


@pytest.mark.parametrize(
    "name", ["../../evil", "/etc/passwd", "..", ".", "", "a\x00b", "a/b", "x" * 500, "\ud800", "ü"]
)
def test_no_name_escapes_the_folder(tmp_path: Path, name: str) -> None:
    """Whatever a package or module is called, its file is inside."""
    out = tmp_path / "deep" / "out"
    extraction = make_extraction(make_package(name, make_module("p", name, CMD_VEL), make_module(name, "m")))
    written = write_manifests(extraction, out)
    everything = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert sorted(everything) == sorted(written)
    assert all(
        path.resolve().is_relative_to(out.resolve()) and len(path.relative_to(out).parts) == 2 for path in written
    )


def test_names_that_differ_have_files_that_differ(tmp_path: Path) -> None:
    """Names that are made safe do not fall together."""
    package = make_package("p", make_module("p", "a/b"), make_module("p", "a:b"), make_module("p", "a_b"))
    assert len(set(write_manifests(make_extraction(package), tmp_path))) == 3


def test_packages_of_one_name_keep_their_files(tmp_path: Path) -> None:
    """A tree may hold a package twice."""
    module = make_module("p", "m")
    packages = [make_package("p", module, path="a"), make_package("p", module, module, path="b")]
    written = write_manifests(make_extraction(*packages), tmp_path)
    assert len(set(written)) == 3


def test_a_second_run_changes_nothing(tmp_path: Path) -> None:
    """Same input, same bytes, no left-overs."""
    first = {path: path.read_bytes() for path in write_manifests(demo(), tmp_path)}
    assert {path: path.read_bytes() for path in write_manifests(demo(), tmp_path)} == first
    assert {path for path in tmp_path.rglob("*") if path.is_file()} == set(first)


def test_what_has_not_changed_is_left_alone(tmp_path: Path) -> None:
    """A file is written when its content is another, so that a build makes nothing anew for the same contract."""
    made = make_extraction(make_package("p", make_module("one", "m"), make_module("two", "m")))
    first, other, *_ = write_manifests(made, tmp_path)
    os.utime(first, ns=(1, 1))
    other.write_bytes(b"#" * other.stat().st_size)
    os.utime(other, ns=(1, 1))
    write_manifests(made, tmp_path)
    assert first.stat().st_mtime_ns == 1
    assert other.stat().st_mtime_ns > 1


def test_a_module_that_is_gone_loses_its_manifest(tmp_path: Path) -> None:
    """Whoever reads the folder must not see a module that is no longer there; other files are left alone."""
    both = make_package("p", make_module("p", "old"), make_module("p", "new"))
    old, _ = write_manifests(make_extraction(both), tmp_path)
    mine = tmp_path / "p" / "mine.ecm.yaml"
    mine.write_text("something else")
    write_manifests(make_extraction(make_package("p", make_module("p", "new"))), tmp_path)
    assert not old.exists()
    assert mine.exists()


def test_links_are_not_followed(tmp_path: Path) -> None:
    """A repository that brings a link in place of our folder does not make us write elsewhere."""
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "base").symlink_to(elsewhere)
    with pytest.raises(InputError, match="symbolic link"):
        write_manifests(demo(), tmp_path / "out")
    assert not list(elsewhere.iterdir())


def test_a_linked_file_is_replaced(tmp_path: Path) -> None:
    """The target of a link keeps its content."""
    target = tmp_path / "precious"
    target.write_text("precious")
    link = tmp_path / "out" / "base" / "ecm.base.driver.ecm.yaml"
    link.parent.mkdir(parents=True)
    link.symlink_to(target)
    write_manifests(demo(), tmp_path / "out")
    assert target.read_text() == "precious"
    assert not link.is_symlink()


def test_a_folder_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    """The error names the folder and what to do."""
    (tmp_path / "out").write_text("a file")
    with pytest.raises(InputError, match="out") as caught:
        write_manifests(demo(), tmp_path / "out")
    assert "-o DIR" in caught.value.hint
