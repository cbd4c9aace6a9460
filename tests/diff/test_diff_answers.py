"""`diff` as a release check: the step that is declared, what is accepted, and what a comment answers."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release, write
from git_repos import git
from hypothesis import given
from hypothesis import strategies as st

from ecm_extract.cli.run import run
from ecm_extract.diff.steps import is_enough, version_for

MSG = "arm_msgs/msg/Grip.msg"
READER = {
    "user/package.xml": package("user"),
    "user/user/watch.py": "from arm_msgs.msg import Grip\n\ngrip = Grip()\nprint(grip.force)\n",
}


@pytest.fixture
def repo(tmp_path: Path) -> Path:
    """A field is renamed; who reads it lies in the same repository."""
    folder = tmp_path / "arm"
    first = {"arm_msgs/package.xml": package("arm_msgs"), MSG: "float64 force\nbool open\n", **READER}
    release(folder, dict(first), "1.0.0")
    write(folder, {MSG: "float64 max_force\nbool open\n"})
    return folder


def diff(capsys: pytest.CaptureFixture[str], repo: Path, *args: object) -> tuple[int, dict[str, Any], str]:
    capsys.readouterr()
    status = run(["diff", "1.0.0", ".", "--repo", str(repo), "--format", "json", *map(str, args)])
    captured = capsys.readouterr()
    return status, json.loads(captured.out), captured.err


def accept(*arguments: object) -> int:
    return run(["accept", *map(str, arguments), "--reason", "meant"])


def test_one_accept_is_for_the_change_and_for_what_it_breaks(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The change of `diff`, its reader (VER001) and the finding of `lint --base` (LNT019) go together."""
    _, found, _ = diff(capsys, repo)
    fingerprints = {each["fingerprint"] for each in (*found["changes"], *found["findings"])}
    assert len(fingerprints) == 1
    assert accept(*fingerprints) == 0
    capsys.readouterr()
    status, left, err = diff(capsys, repo)
    assert (status, left["findings"], [each["accepted"] for each in left["changes"]]) == (0, [], [True])
    assert "1 accepted" in err
    assert run(["lint", str(repo), "--base", "1.0.0", "--fail-on", "info"]) == 0
    assert run(["lint", str(repo)]) in (0, 1)
    assert "unused" not in capsys.readouterr().err


def test_text_shows_what_to_accept(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The digits stand behind each breaking change, and what to do is said."""
    _, found, _ = diff(capsys, repo)
    assert run(["diff", "1.0.0", ".", "--repo", str(repo)]) == 1
    captured = capsys.readouterr()
    assert f"[{found['changes'][0]['fingerprint']}]" in captured.out
    assert "arm_msgs 1.0.0 -> 1.0.0 declares none, needs major: release as 2.0.0" in captured.err
    assert "ecm-extract accept FINGERPRINT" in captured.err


@pytest.mark.parametrize(
    ("path", "comment", "left"),
    [
        (MSG, "# ecm: ignore[LNT019] meant", 0),
        (MSG, "# ecm: ignore[VER001] meant", 0),
        (MSG, "# ecm: ignore[LNT001] something else", 1),
        ("user/user/watch.py", "# ecm: ignore[VER001] known", 0),
    ],
)
def test_a_comment_answers_where_the_line_is(
    path: str, comment: str, left: int, repo: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Beside the change it answers the change and its readers, beside a reader only that one."""
    text = (repo / path).read_text()
    line = "print" if path.endswith(".py") else "float64"
    write(repo, {path: text.replace(line, f"{comment}\n{line}", 1)})
    status, found, _ = diff(capsys, repo)
    assert len(found["findings"]) == left
    assert [each["accepted"] for each in found["changes"]] == [path == MSG and not left]
    assert status == (0 if path == MSG and not left else 1)


def test_each_reader_answers_for_itself(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A comment on one line says nothing about the next one."""
    write(repo, {"user/user/watch.py": READER["user/user/watch.py"].replace(
        "print(grip.force)\n", "print(grip.force)  # ecm: ignore[VER001] known\n\nprint(grip.force)\n"
    )})  # fmt: skip
    _, found, _ = diff(capsys, repo)
    assert [each["evidence"][0]["line"] for each in found["findings"]] == [6]


@pytest.mark.parametrize(
    ("version", "fail_on", "status"),
    [
        ("1.0.0", "error", 1),
        ("1.1.0", "error", 1),
        ("2.0.0", "error", 0),
        ("1.1.0", "info", 1),
        ("2.0.0", "breaking", 1),
        ("1.1.0", "never", 0),
    ],
)
def test_a_step_that_is_too_small_fails(
    version: str, fail_on: str, status: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A release check needs no option and no consumer: the version says whether people were told."""
    folder = tmp_path / "r"
    release(folder, {"package.xml": package("p"), "msg/M.msg": "float64 x\nbool keep\n"}, "1.0.0")
    write(folder, {"package.xml": package("p", version), "msg/M.msg": "float64 y\nbool keep\n"})
    found = diff(capsys, folder, "--fail-on", fail_on)
    assert found[0] == status
    assert bool(found[1]["short_steps"]) is (version != "2.0.0")


@pytest.mark.parametrize(
    ("old", "required", "declared", "enough", "least"),
    [
        ("1.2.3", "major", "major", True, "2.0.0"),
        ("1.2.3", "major", "minor", False, "2.0.0"),
        ("1.2.3", "minor", "patch", False, "1.3.0"),
        ("1.2.3", "patch", "none", False, "1.2.4"),
        ("1.2.3", "none", "none", True, None),
        ("1.2.3", "major", None, False, "2.0.0"),
        ("0.2.3", "major", "minor", True, "0.3.0"),
        ("0.2.3", "minor", "patch", True, "0.2.4"),
        ("0.2.3", "major", "patch", False, "0.3.0"),
        ("0.2.3", "patch", "none", False, "0.2.4"),
        ("soon", "major", "minor", False, None),
    ],
)
def test_steps(old: str, required: Any, declared: Any, enough: bool, least: str | None) -> None:
    """Below 1.0.0 a step counts as the next higher one; what cannot be read is not enough."""
    assert is_enough(declared, required, old) is enough
    assert version_for(old, required) == least


@given(st.tuples(*[st.integers(0, 30)] * 3), st.sampled_from(["patch", "minor", "major"]))
def test_the_version_that_is_named_is_enough(parts: tuple[int, ...], required: Any) -> None:
    """Who follows the advice passes."""
    from ecm_checker.versions import bump_between

    old = ".".join(map(str, parts))
    assert is_enough(bump_between(old, version_for(old, required)), required, old)


def test_a_package_that_goes_needs_the_step_of_the_others(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It has no version of its own any more; a package that comes promises nothing yet."""
    folder = tmp_path / "r"
    both = {"a/package.xml": package("a"), "b/package.xml": package("b"), "b/msg/M.msg": "bool x\n"}
    release(folder, dict(both), "1.0.0")
    gone = {"b/package.xml": None, "b/msg/M.msg": None, "c/package.xml": package("c"), "c/msg/N.msg": "bool x\n"}
    write(folder, {**gone, "a/package.xml": package("a", "1.1.0")})
    short = diff(capsys, folder)[1]["short_steps"]
    assert [each["package"] for each in short] == ["b"]
    write(folder, {"a/package.xml": package("a", "2.0.0")})
    assert diff(capsys, folder)[1]["short_steps"] == []


def test_changes_of_no_commit_are_told(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What was compared is not what HEAD holds."""
    _, found, err = diff(capsys, repo)
    head = git(repo, "rev-parse", "HEAD")
    assert f"against:  . {head[:12]} with uncommitted changes" in err
    assert found["new"] == {"ref": ".", "commit": head, "uncommitted": True}
    git(repo, "add", "-A")
    git(repo, "commit", "-q", "-m", "x")
    assert "uncommitted" not in diff(capsys, repo)[1]["new"]


def test_rows_of_a_change_that_is_no_more_are_told(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By `diff`, which sees all changes; a plain lint sees none, so it says nothing."""
    (fingerprint,) = {each["fingerprint"] for each in diff(capsys, repo)[1]["changes"]}
    assert accept(fingerprint) == 0
    write(repo, {MSG: "float64 force\nbool open\n"})
    assert f"unused: ecm-accepted.toml: {fingerprint}" in diff(capsys, repo)[2]
    run(["lint", str(repo)])
    assert "unused" not in capsys.readouterr().err


def test_a_backport_that_breaks_fails(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The line says no, and so does the status."""
    assert run(["diff", "1.0.0", ".", "--repo", str(repo), "--backport"]) == 1
    assert capsys.readouterr().out.startswith("backport: no")


def test_a_key_of_yaml_has_its_column(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The mark of the text stands below the key, and the JSON document names the column."""
    folder = tmp_path / "r"
    config = "arm:\n  ros__parameters:\n    speed: 1.0\n"
    files = {"package.xml": package("p"), "config/arm.yaml": config}
    release(folder, {**files, "src/a.cpp": node('declare_parameter("speed", 1.0);')}, "1.0.0")
    write(folder, {"src/a.cpp": node('declare_parameter("pace_of_arm", true);')})
    _, found, _ = diff(capsys, folder)
    assert [(each["line"], each.get("column")) for each in found["findings"][0]["evidence"][:1]] == [(3, 5)]
    monkeypatch.chdir(folder)
    run(["diff", "1.0.0", "."])
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("config/arm.yaml:3:5: ")
    assert lines[1:3] == ["    3 |     speed: 1.0", "      |     ^"]


def test_the_verdict_counts_as_people_do(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One change is no changes."""
    err = diff(capsys, repo)[2]
    assert "verdict: breaking, needs major, declares none; 1 change, 1 breaking; 1 finding\n" in err
