"""Indexing of clones: all releases, once, and what could not be read is told."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from clones import clone_of_three, release
from git_repos import commit_all, git
from sample import driver, write

from ecm_extract.cli.run import run as main
from ecm_extract.registry.index import Outcome, jobs_of, run, split_known
from ecm_extract.registry.releases import list_releases
from ecm_extract.registry.store import Registry
from ecm_extract.registry.verify import verify
from ecm_extract.registry.workers import Here, Processes


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """Three releases and a candidate."""
    return clone_of_three(tmp_path / "robot")


def _run(registry: Registry, url: str, clone: Path, pattern: str | None = None) -> list[Outcome]:
    todo, known = split_known(registry, jobs_of(clone, pattern))
    return [*known, *run(url, todo, Here())]


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
    with Registry.create(url) as registry:
        assert sorted(each.state for each in run(url, jobs_of(clone, None), Processes(2))) == ["indexed"] * 3
        with registry.reading() as session:
            assert len(list_releases(session)) == 3


def test_a_tag_that_moved_is_told(small: Registry, tmp_path: Path, clone: Path) -> None:
    """What is stored never changes."""
    url = str(tmp_path / "small.sqlite")
    _run(small, url, clone)
    write(clone, driver("1.2.0", topic="other"))
    git(clone, "commit", "-q", "-a", "-m", "again")
    git(clone, "tag", "-f", "1.2.0")
    moved = [each for each in _run(small, url, clone) if each.state == "skipped"]
    assert "its tag moved" in moved[0].skipped[0]


def test_another_clone_of_the_same_name_is_told(small: Registry, tmp_path: Path, clone: Path) -> None:
    """Without a remote a clone is called like its folder; the tags of another one are not these."""
    url = str(tmp_path / "small.sqlite")
    jobs = [*jobs_of(clone, "1.0.0"), msgspec.structs.replace(jobs_of(clone, "1.1.0")[0], tag="1.0.0")]
    assert [each.state for each in run(url, jobs, Here())] == ["indexed", "skipped"]


def test_a_version_that_was_not_raised_is_told(small: Registry, tmp_path: Path, clone: Path) -> None:
    """Other content under the version of the tag before."""
    url = str(tmp_path / "small.sqlite")
    release(clone, "1.4.0", driver("1.2.0", topic="other"))
    told = [why for each in _run(small, url, clone) for why in each.skipped]
    assert len(told) == 1
    assert "driver@1.2.0: it is stored with other content" in told[0]


def test_the_command_tells_what_was_skipped(tmp_path: Path, clone: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Status 1 when a tag holds nothing."""
    url = str(tmp_path / "new.sqlite")
    git(clone, "rm", "-q", "-r", ".")
    write(clone, {"notes": "empty"})
    commit_all(clone, "2.0.0")
    assert main(["registry", "init", "--registry", url]) == 0
    assert main(["registry", "index", str(clone), "--jobs", "1", "--registry", url]) == 1
    out, err = capsys.readouterr()
    assert "3 indexed, 0 known before, 1 skipped; 3 new releases" in out
    assert "it holds no ROS package" in err


def test_a_file_is_not_shared_by_a_cluster(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """SQLite locks within one machine."""
    url = str(tmp_path / "registry.sqlite")
    assert main(["registry", "init", "--registry", url]) == 0
    assert main(["registry", "index", str(tmp_path), "--dask", "tcp://127.0.0.1:9", "--registry", url]) == 2
    assert "cannot share a registry that is a file" in capsys.readouterr().err
