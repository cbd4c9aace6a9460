"""`lint --base`: only what a change brings in, on its lines."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from git_repos import commit_all
from lint_fixtures import FIXTURES

from ecm_extract.cli.run import run
from ecm_extract.lint.hunks import PatchError, landing_line, touched_lines


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """The good twin of a rule, committed, with the bad fixture of another in its past."""
    folder = tmp_path / "ws"
    shutil.copytree(FIXTURES / "LNT005" / "good", folder)
    old = folder / "demo" / "launch" / "old.launch.xml"
    old.write_text('<launch>\n  <node pkg="demo" exec="gone"/>\n</launch>\n')
    commit_all(folder)
    return folder


def lint(folder: Path, capsys: pytest.CaptureFixture[str]) -> list[tuple[str, str, int]]:
    assert run(["lint", str(folder), "--preview", "--base", "HEAD", "--format", "json", "--fail-on", "never"]) == 0
    found = json.loads(capsys.readouterr().out)["findings"]
    return [(each["rule"], each["evidence"][0]["path"], each["evidence"][0]["line"]) for each in found]


def test_what_was_there_before_is_not_said(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The missing program of the base is not this change's; neither is it when its line moves."""
    assert lint(repository, capsys) == []
    old = repository / "demo" / "launch" / "old.launch.xml"
    old.write_text(old.read_text().replace("<launch>", "<launch>\n  <!-- moved -->"))
    assert lint(repository, capsys) == []


def test_new_finding_is_said(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The line that the change spoils."""
    path = repository / "demo" / "launch" / "a.launch.xml"
    path.write_text(path.read_text().replace("max_speed", "max_sped"))
    assert ("LNT005", "demo/launch/a.launch.xml", 3) in lint(repository, capsys)


def test_removed_interface_stands_where_it_stood(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A parameter that is gone is reported on the line that takes its place."""
    path = repository / "demo" / "src" / "base.cpp"
    lines = path.read_text().splitlines(keepends=True)
    at = next(number for number, line in enumerate(lines) if "max_speed" in line)
    path.write_text("".join(lines[:at] + lines[at + 1 :]))
    found = lint(repository, capsys)
    assert ("LNT019", "demo/src/base.cpp", at + 1) in found


@pytest.mark.parametrize(("version", "said"), [("1.0.0", False), ("1.0.1", True), ("2.0.0", False)])
def test_version_that_is_raised_too_little(
    version: str, said: bool, repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A release that breaks somebody is a major one; a change that is no release asks for nothing."""
    source = repository / "demo" / "src" / "base.cpp"
    source.write_text("\n".join(line for line in source.read_text().splitlines() if "max_speed" not in line))
    manifest = repository / "demo" / "package.xml"
    manifest.write_text(manifest.read_text().replace("1.0.0", version))
    found = lint(repository, capsys)
    assert (("LNT030", "demo/package.xml", 4) in found) is said


def test_a_version_step_need_not_tell_what_is_accepted(repository: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One accept of a change answers the version that it would need, as in diff."""
    source = repository / "demo" / "src" / "base.cpp"
    source.write_text("\n".join(line for line in source.read_text().splitlines() if "max_speed" not in line))
    manifest = repository / "demo" / "package.xml"
    manifest.write_text(manifest.read_text().replace("1.0.0", "1.0.1"))
    assert {"LNT019", "LNT030"} <= {rule for rule, _, _ in lint(repository, capsys)}
    run(["lint", str(repository), "--preview", "--base", "HEAD", "--format", "json"])
    shown = json.loads(capsys.readouterr().out)["findings"]
    fingerprints = {each["fingerprint"] for each in shown if each["rule"] == "LNT019"}
    for each in fingerprints:
        run(["accept", each, "--reason", "meant", "--path", str(repository), "--force"])
    capsys.readouterr()
    assert not {"LNT019", "LNT030"} & {rule for rule, _, _ in lint(repository, capsys)}


@pytest.mark.parametrize(
    ("old", "new", "line", "lands"),
    [
        (b"a\nb\nc\n", b"a\nb\nc\n", 2, 2),
        (b"a\nb\nc\n", b"x\na\nb\nc\n", 2, 3),
        (b"a\nb\nc\n", b"a\nc\n", 2, 2),
        (b"a\nb\nc\n", b"a\n", 3, 1),
        (b"a\n", None, 1, 1),
    ],
)
def test_landing_line(old: bytes, new: bytes | None, line: int, lands: int) -> None:
    """A line that is gone lands where the next one is now."""
    assert landing_line(old, new, line) == lands


def test_touched_lines() -> None:
    """Added lines, and for a pure removal the line it leaves behind."""
    patch = "--- a/x\n+++ b/x\n@@ -1,2 +1,3 @@\n a\n+b\n c\n@@ -9,2 +10,1 @@\n d\n-e\n"
    assert touched_lines(patch) == {"x": {2, 10}}


def test_a_line_number_of_thousands_of_digits_is_no_patch() -> None:
    """What no tool writes is the input's fault."""
    with pytest.raises(PatchError):
        touched_lines(f"--- a/x\n+++ b/x\n@@ -{'1' * 5000} +1 @@\n-a\n+b\n")
