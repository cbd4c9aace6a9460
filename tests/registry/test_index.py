"""Indexing of clones: all releases, once, and what could not be read is told."""

from __future__ import annotations

import subprocess
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import msgspec
import pytest
from sample import driver, panel, write
from workers import context

from ecm_extract.cli.run import run as main
from ecm_extract.registry.index import Outcome, jobs_of, run, split_known
from ecm_extract.registry.releases import list_releases
from ecm_extract.registry.store import Registry
from ecm_extract.registry.verify import verify


def _git(folder: Path, *words: str) -> None:
    identity = ["-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *identity, *words], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """Three releases and a candidate."""
    folder = tmp_path / "robot"
    folder.mkdir()
    _git(folder, "init", "-q", "-b", "main")
    for version, files in (("1.0.0", driver()), ("1.1.0", panel()), ("1.2.0", driver("1.2.0", topic="status"))):
        _release(folder, version, files)
    _git(folder, "tag", "1.3.0-rc1")
    return folder


def _release(folder: Path, tag: str, files: dict[str, str]) -> None:
    write(folder, files)
    _git(folder, "add", "-A")
    _git(folder, "commit", "-q", "-m", tag)
    _git(folder, "tag", tag)


def _run(registry: Registry, url: str, clone: Path, pattern: str | None = None) -> list[Outcome]:
    todo, known = split_known(registry, jobs_of(clone, pattern))
    return [*known, *run(url, todo, None)]


def test_all_tags_become_releases(registry: Registry, url: str, clone: Path) -> None:
    """A package that did not change in a tag is not released anew."""
    assert [each.state for each in _run(registry, url, clone)] == ["indexed"] * 3
    with registry.reading() as session:
        names = [(each.name, each.tag) for each in list_releases(session)]
        assert verify(session).problems == ()
    assert names == [("driver@1.0.0", "1.0.0"), ("driver@1.2.0", "1.2.0"), ("panel@1.0.0", "1.1.0")]


def test_a_second_run_goes_on(small: Registry, tmp_path: Path, clone: Path) -> None:
    """What is done is not read again."""
    url = str(tmp_path / "small.sqlite")
    assert [each.tag for each in _run(small, url, clone, "1.0.*")] == ["1.0.0"]
    assert [each.state for each in _run(small, url, clone)] == ["known", "indexed", "indexed"]


def test_processes_do_the_same(url: str, clone: Path) -> None:
    """The same job runs anywhere."""
    with Registry.create(url) as registry, ProcessPoolExecutor(2, mp_context=context()) as pool:
        assert sorted(each.state for each in run(url, jobs_of(clone, None), pool)) == ["indexed"] * 3
        with registry.reading() as session:
            assert len(list_releases(session)) == 3


def test_a_tag_that_moved_is_told(small: Registry, tmp_path: Path, clone: Path) -> None:
    """What is stored never changes."""
    url = str(tmp_path / "small.sqlite")
    _run(small, url, clone)
    write(clone, driver("1.2.0", topic="other"))
    _git(clone, "commit", "-q", "-a", "-m", "again")
    _git(clone, "tag", "-f", "1.2.0")
    moved = [each for each in _run(small, url, clone) if each.state == "skipped"]
    assert "its tag moved" in moved[0].skipped[0]


def test_another_clone_of_the_same_name_is_told(small: Registry, tmp_path: Path, clone: Path) -> None:
    """Without a remote a clone is called like its folder; the tags of another one are not these."""
    url = str(tmp_path / "small.sqlite")
    jobs = [*jobs_of(clone, "1.0.0"), msgspec.structs.replace(jobs_of(clone, "1.1.0")[0], tag="1.0.0")]
    assert [each.state for each in run(url, jobs, None)] == ["indexed", "skipped"]


def test_a_version_that_was_not_raised_is_told(small: Registry, tmp_path: Path, clone: Path) -> None:
    """Other content under the version of the tag before."""
    url = str(tmp_path / "small.sqlite")
    _release(clone, "1.4.0", driver("1.2.0", topic="other"))
    told = [why for each in _run(small, url, clone) for why in each.skipped]
    assert len(told) == 1
    assert "driver@1.2.0: it is stored with other content" in told[0]


def test_the_command_tells_what_was_skipped(tmp_path: Path, clone: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Status 1 when a tag holds nothing."""
    url = str(tmp_path / "new.sqlite")
    subprocess.run(["git", "rm", "-q", "-r", "."], cwd=clone, check=True)
    write(clone, {"notes": "empty"})
    _git(clone, "add", "-A")
    _git(clone, "commit", "-q", "-m", "empty")
    _git(clone, "tag", "2.0.0")
    assert main(["registry", "init", "--registry", url]) == 0
    assert main(["registry", "index", str(clone), "--jobs", "1", "--registry", url]) == 1
    out, err = capsys.readouterr()
    assert "3 indexed, 0 known before, 1 skipped; 3 new releases" in out
    assert "it holds no ROS package" in err
