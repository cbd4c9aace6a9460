"""`accept` takes what was shown, for as long as it is to count, and tells where it stands."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from lint_fixtures import FIXTURES, ROOT

from ecm_extract.cli.run import run

UNSEEN = "deadbeefdeadbeef"


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A repository whose packages lie in `src`."""
    shutil.copytree(FIXTURES / "LNT003" / "bad", tmp_path / "repo" / "src")
    subprocess.run(["git", "init", "-q"], cwd=tmp_path / "repo", check=True)
    return tmp_path / "repo"


def shown(folder: Path, capsys: pytest.CaptureFixture[str]) -> str:
    capsys.readouterr()
    run(["lint", str(folder), "--format", "json"])
    fingerprint: str = json.loads(capsys.readouterr().out)["findings"][0]["fingerprint"]
    return fingerprint


def test_what_nothing_has_shown_is_refused(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A slip of the pen would look like an answer; --force takes what another machine has shown."""
    wanted = ["accept", UNSEEN, "--reason", "x", "--path", str(repository)]
    assert run(wanted) == 2
    assert "--force" in capsys.readouterr().err
    assert not (repository / "ecm-accepted.toml").exists()
    assert run([*wanted, "--force"]) == 0
    assert UNSEEN in (repository / "ecm-accepted.toml").read_text()


@pytest.mark.parametrize(("until", "status"), [("2020-01-01", 2), ("soon", 2), ("2999-01-01", 0)])
def test_a_day_that_has_passed_is_refused(
    until: str, status: int, repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It would accept nothing."""
    fingerprint = shown(repository, capsys)
    assert run(["accept", fingerprint, "--reason", "x", "--until", until]) == status


@pytest.mark.parametrize("path", ["repo", "repo/src", "repo/src/demo"])
def test_one_file_for_the_whole_repository(path: str, repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whichever folder is linted, the row lands in the root and is found from everywhere."""
    fingerprint = shown(repository.parent / path, capsys)
    assert run(["accept", fingerprint, "--reason", "started by hand"]) == 0
    err = capsys.readouterr().err
    assert f"written: {repository / 'ecm-accepted.toml'}" in err
    assert "accepted: LNT003 executable_missing: " in err
    assert run(["lint", str(repository)]) == 0
    assert run(["lint", str(repository / "src")]) == 0


def test_a_link_is_neither_read_nor_written(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It could lead out of the repository."""
    fingerprint = shown(repository, capsys)
    outside = tmp_path / "outside.toml"
    outside.write_text("")
    (repository / "ecm-accepted.toml").symlink_to(outside)
    assert run(["accept", fingerprint, "--reason", "x"]) == 2
    assert run(["lint", str(repository)]) == 2
    assert outside.read_text() == ""


def test_check_reads_the_same_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A conflict that is accepted decides nothing any more; a plain lint does not miss it."""
    bad = tmp_path / "contracts"
    shutil.copytree(ROOT / "fixtures" / "rules" / "RES001" / "bad", bad)
    wanted = ["check", str(bad), "--together"]
    assert run([*wanted, "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)["findings"]
    for fingerprint in {each["fingerprint"] for each in found}:
        assert run(["accept", fingerprint, "--reason", "an arbiter decides"]) == 0
    assert 'scope = "check"' in (bad / "ecm-accepted.toml").read_text()
    capsys.readouterr()
    assert run([*wanted, "--format", "json"]) == 0
    captured = capsys.readouterr()
    assert json.loads(captured.out)["outcome"] == "accept"
    assert "answered" in captured.err
    assert run([*wanted]) == 0
    assert "accept:" not in capsys.readouterr().out
