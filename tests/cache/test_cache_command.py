"""`ecm-extract cache info|clear`, and the switch."""

from __future__ import annotations

from pathlib import Path

import click
import pytest
from cache_trees import extraction, keys, package

from ecm_extract.cache.store import Store
from ecm_extract.cli.app import app
from ecm_extract.cli.run import run


def test_info_tells_where_and_how_much(store: Store, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A person finds the folder, the number of entries, the size and the version."""
    extraction(package(tmp_path / "one"))
    assert run(["cache", "info"]) == 0
    out = capsys.readouterr().out
    assert f"folder:  {store.folder}" in out
    assert "entries: 5" in out
    assert "of at most 500 MB" in out
    assert "version: facts " in out


def test_info_tells_why_it_is_not_used(store: Store, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder that is a link is named as the reason."""
    (tmp_path / "real").mkdir()
    (tmp_path / "real" / "cache-1.sqlite").write_bytes(b"")
    store.folder.symlink_to(tmp_path / "real")
    assert run(["cache", "info"]) == 0
    assert "not used: it is a symbolic link" in capsys.readouterr().out


def test_clear_deletes(store: Store, tmp_path: Path) -> None:
    """After it nothing is known; without anything to delete it is content, too."""
    extraction(package(tmp_path / "one"))
    for _ in range(2):
        assert run(["cache", "clear"]) == 0
        assert keys(store) == []


def test_clear_follows_no_link(store: Store, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A link in the place of the folder is an error, and what it leads to stays."""
    (tmp_path / "real").mkdir()
    (tmp_path / "real" / "cache-1.sqlite").write_bytes(b"x")
    store.folder.symlink_to(tmp_path / "real")
    assert run(["cache", "clear"]) == 2
    assert "symbolic link" in capsys.readouterr().err
    assert (tmp_path / "real" / "cache-1.sqlite").exists()


@pytest.mark.parametrize("name", ["extract", "diff", "check", "system", "init"])
def test_commands_that_read_trees_have_the_switch(name: str) -> None:
    """Every one of them can do without the cache."""
    command = app.get_command(click.Context(app), name)
    assert command is not None
    assert "--no-cache" in [option for each in command.params for option in each.opts]


def test_switch_keeps_nothing(store: Store, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With the switch no command leaves a trace."""
    folder = str(package(tmp_path / "one"))
    (tmp_path / "one" / "l.launch.xml").write_text('<launch><node pkg="pkg" exec="a"/></launch>')
    package(tmp_path / "two", "other")
    for line in (
        ["extract", folder, "--format", "summary"],
        ["check", folder],
        ["init", folder, "--print"],
        ["diff", folder, str(tmp_path / "two")],
        ["system", "l.launch.xml", "--workspace", folder],
    ):
        assert run([*line, "--no-cache"]) in (0, 1), line
        assert keys(store) == [], line
        run(line)
        assert keys(store), line
        store.clear()
    capsys.readouterr()
