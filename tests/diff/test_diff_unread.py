"""`diff` and what it could not read: no all-clear for what nobody has looked at."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release
from git_repos import git

from ecm_extract.cli.run import run

OLD: dict[str, str | None] = {
    "arm/package.xml": package("arm"),
    "arm/src/arm.cpp": node('declare_parameter("rate", 1.0);'),
    "arm_msgs/package.xml": package("arm_msgs"),
    "arm_msgs/msg/Grip.msg": "float64 force\n",
}
NEW: dict[str, str | None] = {
    "arm/package.xml": package("arm", "1.1.0"),
    "arm/src/arm.cpp": node('declare_parameter("speed", 1.0);'),
    "arm_msgs/msg/Grip.msg": "float64 max_force\n",
}
Diff = Callable[..., tuple[int, dict[str, Any]]]


@pytest.fixture
def diff(capsys: pytest.CaptureFixture[str]) -> Diff:
    """A function from a repository and refs to the exit status and the document."""

    def compare(repo: Path, old: str = "1.0.0", new: str = "1.1.0", *more: str) -> tuple[int, dict[str, Any]]:
        status = run(["diff", old, new, "--repo", str(repo), "--format", "json", "--no-cache", *more])
        return status, json.loads(capsys.readouterr().out)

    return compare


@pytest.fixture
def full(tmp_path: Path) -> Path:
    """A repository whose release 1.1.0 breaks 1.0.0, which others may clone in part."""
    release(tmp_path / "full", OLD, "1.0.0")
    release(tmp_path / "full", NEW, "1.1.0")
    git(tmp_path / "full", "config", "uploadpack.allowFilter", "true")
    return tmp_path / "full"


def cloned(full: Path, *options: str) -> Path:
    folder = full.parent / "clone"
    git(full.parent, "clone", "-q", *options, f"file://{full}", str(folder))
    return folder


def limiting(found: dict[str, Any]) -> set[tuple[str, str, str]]:
    return {(each["path"], each["reason"], each["side"]) for each in found["unread"] if each["limits"]}


def test_partial_clone_without_content(full: Path, diff: Diff) -> None:
    """Nothing was read, so nothing is known, and the status is not that of a comparison."""
    status, found = diff(cloned(full, "--no-checkout", "--filter=blob:none"))
    assert (status, found["changes"]) == (2, [])
    assert found["verdict"]["complete"] is False
    assert found["verdict"]["compatibility_class"] == "unknown"
    assert limiting(found) >= {
        ("arm/src/arm.cpp", "missing", "both"),
        ("arm/package.xml", "missing", "both"),
        ("arm_msgs/msg/Grip.msg", "missing", "both"),
    }


def test_partial_clone_with_one_side(full: Path, diff: Diff) -> None:
    """A checkout has the content of its own commit only."""
    status, found = diff(cloned(full, "--filter=blob:none"))
    assert status == 2
    assert ("arm/src/arm.cpp", "missing", "old") in limiting(found)
    assert {each["package"]: each["complete"] for each in found["packages"]} == {"arm": False, "arm_msgs": False}


def test_what_mends_a_partial_clone(full: Path, diff: Diff, capsys: pytest.CaptureFixture[str]) -> None:
    """The line that is told gets what was missing."""
    clone = cloned(full, "--no-checkout", "--filter=blob:none")
    run(["diff", "1.0.0", "1.1.0", "--repo", str(clone), "--no-cache"])
    line = capsys.readouterr().out.splitlines()[0]
    git(clone, *line.partition("`git ")[2].partition("`")[0].split())
    status, found = diff(clone, "1.0.0", "1.1.0", "--fail-on", "never")
    assert (status, found["verdict"]["complete"], found["unread"]) == (0, True, [])
    assert found["verdict"]["compatibility_class"] == "breaking"


@pytest.mark.parametrize(
    ("form", "start"),
    [
        ("text", "unknown: not everything could be read: 4 file(s) not in this clone: "),
        ("markdown", "**Interface changes: unknown.** Needs unknown, declares unknown. Not everything could be read: "),
    ],
)
def test_the_first_line_says_it(full: Path, capsys: pytest.CaptureFixture[str], form: str, start: str) -> None:
    """Who reads one line reads that."""
    clone = cloned(full, "--no-checkout", "--filter=blob:none")
    assert run(["diff", "1.0.0", "1.1.0", "--repo", str(clone), "--format", form]) == 2
    assert capsys.readouterr().out.startswith(start)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--format", "html"], "Not everything could be read"),
        (["--format", "migration"], "Not everything could be read"),
        (["--backport"], "backport: unknown"),
    ],
)
def test_no_format_gives_the_all_clear(
    full: Path, capsys: pytest.CaptureFixture[str], options: list[str], text: str
) -> None:
    """Neither a page, nor a guide, nor the one line for a backport."""
    clone = cloned(full, "--no-checkout", "--filter=blob:none")
    assert run(["diff", "1.0.0", "1.1.0", "--repo", str(clone), *options]) == 2
    out = capsys.readouterr().out
    assert text in out
    assert "Nothing has to be changed" not in out


def test_what_is_known_to_break_stays_so(full: Path, diff: Diff) -> None:
    """A breaking change is a fact whatever else there is; a lesser step is only the least."""
    blob = git(full, "rev-parse", "1.0.0:arm/src/arm.cpp")
    (full / ".git" / "objects" / blob[:2] / blob[2:]).unlink()
    status, found = diff(full)
    assert status == 2
    assert found["verdict"]["compatibility_class"] == "breaking"
    assert found["verdict"]["complete"] is False


@pytest.mark.parametrize("text", ["<package><name>arm</na", "<pkg/>", "<package/>", ""])
def test_manifest_that_is_none(full: Path, diff: Diff, text: str) -> None:
    """No build tool would take it, so nobody knows which package it is and at which version."""
    release(full, {"arm/package.xml": text}, "1.2.0")
    status, found = diff(full, "1.1.0", "1.2.0")
    assert status == 2
    assert ("arm/package.xml", "malformed", "new") in limiting(found)


def test_file_above_the_bound(full: Path, diff: Diff, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is too large to be parsed can hide a change; who leaves it out on purpose has been told."""
    monkeypatch.setattr("ecm_extract.tree.git_ref.MAX_FILE_BYTES", 2_000)
    release(full, {"arm/src/big.cpp": "// x\n" * 1_000}, "1.2.0")
    status, found = diff(full, "1.1.0", "1.2.0")
    assert (status, limiting(found)) == (2, {("arm/src/big.cpp", "too-large", "new")})
    release(full, {"ecm.toml": '[extract]\nexclude = ["big.cpp"]\n'}, "1.3.0")
    release(full, {"arm/package.xml": package("arm", "1.3.1")}, "1.3.1")
    status, found = diff(full, "1.3.0", "1.3.1")
    assert (status, limiting(found)) == (0, set())
    assert [(each["path"], each["reason"], each["side"]) for each in found["unread"]] == [
        ("big.cpp", "excluded", "both")
    ]


# --- what parsers do not read --------------------------------------------------------------------------------


LONG = {
    "a Python module": ("arm/arm/big.py", "x = 1\n" * 350_000),
    "a parameter file": ("arm/config/big.yaml", "arm:\n  ros__parameters:\n" + "    a: [" + "1, " * 250_000 + "1]\n"),
    "a launch file": ("arm/launch/big.launch.py", "# x\n" * 150_000),
    "a description": ("arm/urdf/big.urdf", "<robot name='a'>" + "<a>" * 600 + "</a>" * 600 + "</robot>"),
}


@pytest.mark.parametrize("what", LONG)
def test_bound_of_a_parser(full: Path, diff: Diff, what: str) -> None:
    """A file that the tree gives and a parser leaves can hide a change as well."""
    path, text = LONG[what]
    installs = "install(DIRECTORY config launch urdf DESTINATION share/arm)\n"
    release(full, {path: text, "arm/CMakeLists.txt": installs}, "1.2.0")
    status, found = diff(full, "1.1.0", "1.2.0")
    assert (path, "too-large", "new") in limiting(found)
    assert status == 2


# --- what the project leaves out -------------------------------------------------------------------------------


def test_the_same_marker_on_both_sides(full: Path, diff: Diff) -> None:
    """Nobody builds the folder, before as after."""
    release(full, {"arm/COLCON_IGNORE": ""}, "1.2.0")
    release(full, {"arm/src/arm.cpp": node('declare_parameter("other", 1.0);')}, "1.3.0")
    status, found = diff(full, "1.2.0", "1.3.0")
    assert (status, found["verdict"]["complete"], found["changes"]) == (0, True, [])
    assert [(each["path"], each["reason"], each["side"]) for each in found["unread"]] == [("arm", "ignored", "both")]


@pytest.mark.parametrize(
    ("file", "text", "told"),
    [
        ("arm/COLCON_IGNORE", "", ("arm", "ignored", "new")),
        ("ecm.toml", '[extract]\nexclude = ["arm/"]\n', ("arm/", "excluded", "new")),
    ],
)
def test_left_out_of_one_side_only(full: Path, diff: Diff, file: str, text: str, told: tuple[str, str, str]) -> None:
    """What the other side has read looks removed, and is perhaps not."""
    release(full, {file: text}, "1.2.0")
    status, found = diff(full, "1.1.0", "1.2.0")
    assert status == 2
    assert limiting(found) == {told}


def test_marker_of_a_folder_that_is_new(full: Path, diff: Diff) -> None:
    """Nothing of it was there before, so nothing of before is missing."""
    release(full, {"more/package.xml": package("more"), "more/COLCON_IGNORE": ""}, "1.2.0")
    status, found = diff(full, "1.1.0", "1.2.0")
    assert (status, found["verdict"]["complete"]) == (0, True)


# --- submodules ------------------------------------------------------------------------------------------------


@pytest.fixture
def outer(full: Path) -> Path:
    """A superproject that moves to the breaking release in 1.1.0 and changes nothing else in 1.2.0."""
    folder = full.parent / "outer"
    release(folder, {"own/package.xml": package("own")}, "0.0.1")
    git(folder, "-c", "protocol.file.allow=always", "submodule", "--quiet", "add", f"file://{full}", "deps/arm")
    for tag in ("1.0.0", "1.1.0"):
        git(folder / "deps" / "arm", "checkout", "-q", tag)
        release(folder, {}, tag)
    release(folder, {"own/package.xml": package("own", "1.2.0")}, "1.2.0")
    return folder


def test_submodule_that_moved(outer: Path, diff: Diff) -> None:
    """Its changes are those of the release."""
    _, found = diff(outer)
    assert found["verdict"] == {
        "compatibility_class": "breaking",
        "required_bump": "major",
        "declared_bump": "none",
        "complete": True,
    }
    assert {"arm", "arm_msgs"} == {each["package"] for each in found["changes"]}


def test_submodule_that_moved_and_is_not_here(outer: Path, full: Path, diff: Diff) -> None:
    """Both commits are named."""
    git(outer.parent, "clone", "-q", f"file://{outer}", "clone")
    status, found = diff(outer.parent / "clone")
    assert status == 2
    told = {"path": "deps/arm", "reason": "submodule", "carries": True, "side": "both", "limits": True}
    commits = {"old": git(full, "rev-parse", "1.0.0"), "new": git(full, "rev-parse", "1.1.0")}
    assert found["unread"] == [told | commits]


def test_submodule_that_stays_and_is_not_here(outer: Path, diff: Diff) -> None:
    """The same commit on both sides has the same interfaces: told, and no reason to doubt."""
    git(outer.parent, "clone", "-q", f"file://{outer}", "clone")
    for new in ("1.2.0", "."):
        status, found = diff(outer.parent / "clone", "1.1.0", new)
        assert (status, found["verdict"]["complete"]) == (0, True)
        assert [(each["path"], each["side"]) for each in found["unread"]] == [("deps/arm", "both")]


# --- what does not exist ---------------------------------------------------------------------------------------


def test_package_that_does_not_exist(full: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The nearest names are told."""
    assert run(["diff", "1.0.0", "1.1.0", "--repo", str(full), "--package", "arn"]) == 2
    assert "no package is called 'arn' in 1.0.0 or 1.1.0\nhint: nearest: arm" in capsys.readouterr().err


def test_package_that_was_read(outer: Path, diff: Diff) -> None:
    """What was not read elsewhere says nothing of the package that was asked for."""
    git(outer.parent, "clone", "-q", f"file://{outer}", "clone")
    status, found = diff(outer.parent / "clone", "1.0.0", "1.1.0", "--package", "own")
    assert (status, found["verdict"]["complete"]) == (0, True)


def test_side_without_any_package(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """No package on a side is a mistake of who asks, not a release without interfaces."""
    release(tmp_path / "r", {"README.md": "x"}, "1.0.0")
    release(tmp_path / "r", {"arm/package.xml": package("arm")}, "1.1.0")
    assert run(["diff", "1.0.0", "1.1.0", "--repo", str(tmp_path / "r")]) == 2
    assert "r@1.0.0 holds no ROS package" in capsys.readouterr().err


def test_consumer_without_any_package(full: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An empty consumer is broken by nothing."""
    (tmp_path / "nobody").mkdir()
    consumer = str(tmp_path / "nobody")
    assert run(["diff", "1.0.0", "1.1.0", "--repo", str(full), "--consumer", consumer]) == 2
    assert "nobody holds no ROS package" in capsys.readouterr().err


def test_first_release(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A tag is there, only none before: no line that fetches would help."""
    release(tmp_path / "r", {"arm/package.xml": package("arm")}, "1.0.0")
    git(tmp_path / "r", "checkout", "-q", "--detach")
    assert run(["diff", "--repo", str(tmp_path / "r")]) == 2
    err = capsys.readouterr().err
    assert "no release tag lies before HEAD, which is the release 1.0.0 itself" in err
    assert "git fetch" not in err


@pytest.mark.parametrize("spec", ["./nothing", "/nothing", "../nothing/at/all"])
def test_folder_that_does_not_exist(full: Path, capsys: pytest.CaptureFixture[str], spec: str) -> None:
    """What is written like a path is told to be none."""
    assert run(["diff", spec, "1.1.0", "--repo", str(full)]) == 2
    assert f"There is no folder {spec}" in capsys.readouterr().err


def test_sides_that_parted(full: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A side that lags lacks what the other gained, which is told before it is called removed."""
    git(full, "checkout", "-q", "-b", "lagging", "1.0.0")
    release(full, {"README.md": "x"}, "1.0.1")
    run(["diff", "1.1.0", "1.0.1", "--repo", str(full)])
    shared = git(full, "rev-parse", "1.0.0")[:12]
    note = f"note: 1.1.0 is not behind 1.0.1: what it has gained since they parted at {shared} is removed here\n"
    assert note in capsys.readouterr().err
    run(["diff", "1.0.0", "1.1.0", "--repo", str(full)])
    assert "note:" not in capsys.readouterr().err


def test_names_that_are_computed_now(tmp_path: Path, diff: Diff) -> None:
    """A release whose node declares by names that are not known is not told to be compatible."""
    folder = tmp_path / "arm"
    for tag, line in (("1.0.0", 'declare_parameter("rate", 1);'), ("1.1.0", "declare_parameter(read_name(), 1);")):
        cmake = "project(arm)\nadd_executable(arm src/arm.cpp)\n"
        files = {"package.xml": package("arm", tag), "CMakeLists.txt": cmake, "src/arm.cpp": node(line)}
        release(folder, files, tag)
    _, document = diff(folder)
    assert document["verdict"]["compatibility_class"] == "unknown"
    assert limiting(document) == {("src/arm.cpp", "unfollowed", "new")}
