"""`lint` and what it could not read, or was asked to read and is not there."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from git_repos import commit_all, git

from ecm_extract.cli.run import run

MANIFEST = "<package format='3'><name>{}</name><version>1.0.0</version><description>d</description></package>"
NODE = """#include <rclcpp/rclcpp.hpp>
int main() { auto node = std::make_shared<rclcpp::Node>("n"); @ }
"""
Lint = Callable[..., tuple[int, dict[str, Any], str]]


@pytest.fixture
def lint(capsys: pytest.CaptureFixture[str]) -> Lint:
    """A function from arguments to the exit status, the document and standard error."""

    def run_lint(*arguments: str | Path) -> tuple[int, dict[str, Any], str]:
        status = run(["lint", *map(str, arguments), "--format", "json"])
        out, err = capsys.readouterr()
        return status, json.loads(out) if out else {}, err

    return run_lint


def commit(folder: Path, files: dict[str, str]) -> str:
    """Commit files on top; returns the id."""
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    commit_all(folder)
    return git(folder, "rev-parse", "HEAD")


def declared(*names: str) -> str:
    return NODE.replace("@", "".join(f'node->declare_parameter("{name}", 1);' for name in names))


@pytest.fixture
def parted(tmp_path: Path) -> Path:
    """A branch that only lags: its base has since added a parameter."""
    folder = tmp_path / "ws"
    commit(folder, {"arm/package.xml": MANIFEST.format("arm"), "arm/src/n.cpp": declared("rate")})
    git(folder, "branch", "lagging")
    commit(folder, {"arm/src/n.cpp": declared("rate", "more")})
    git(folder, "checkout", "-q", "lagging")
    return folder


# --- the base --------------------------------------------------------------------------------------------------


def test_a_branch_that_lags_is_not_blamed(parted: Path, lint: Lint) -> None:
    """What the base added since is nothing that the branch took away; both commits are told."""
    tip, shared = git(parted, "rev-parse", "main"), git(parted, "rev-parse", "HEAD")
    status, found, err = lint(parted, "--base", "main")
    assert (status, [each["rule"] for each in found["findings"]]) == (0, [])
    assert f"base: main {shared[:12]} (merge base of main {tip[:12]} and of this at {shared[:12]})" in err


def test_the_tip_of_the_base(parted: Path, lint: Lint) -> None:
    """Who wants the difference to the base as it is can have it."""
    _, found, err = lint(parted, "--base", "main", "--base-tip")
    assert [each["rule"] for each in found["findings"]] == ["LNT019"]
    assert f"base: main {git(parted, 'rev-parse', 'main')[:12]} (as it is)" in err


def test_what_the_branch_did_is_still_told(parted: Path, lint: Lint) -> None:
    """The change is compared with what it was made of."""
    commit(parted, {"arm/src/n.cpp": declared("speed")})
    _, found, _ = lint(parted, "--base", "main")
    assert "LNT019" in {each["rule"] for each in found["findings"]}


def test_a_folder_at_the_base(parted: Path, lint: Lint) -> None:
    """`REF:subdir` is that folder at the merge base."""
    status, found, _ = lint(parted / "arm", "--base", "main:.")
    assert (status, found["findings"]) == (0, [])


def test_a_shallow_clone_has_no_merge_base(parted: Path, lint: Lint) -> None:
    """The line that gets it is told, and the way around it."""
    clone = parted.parent / "clone"
    git(parted.parent, "clone", "-q", "--depth=1", "--no-single-branch", f"file://{parted}", str(clone))
    status, _, err = lint(clone, "--base", "origin/main")
    assert status == 2
    assert "have no commit in common in this clone, which is shallow" in err
    assert "git fetch --unshallow origin" in err
    assert lint(clone, "--base", "origin/main", "--base-tip")[0] == 0
    git(clone, "fetch", "-q", "--unshallow", "origin")
    assert lint(clone, "--base", "origin/main")[0] == 0


def test_unrelated_histories(parted: Path, lint: Lint) -> None:
    """No fetch would help."""
    git(parted, "checkout", "-q", "--orphan", "island")
    commit(parted, {"island.txt": "x"})
    status, _, err = lint(parted, "--base", "main")
    assert (status, "git fetch" in err, "--base-tip" in err) == (2, False, True)


def test_base_tip_alone(parted: Path, lint: Lint) -> None:
    """An option that has nothing to say is a mistake."""
    assert lint(parted, "--base-tip")[0] == 2


def test_a_base_without_packages(tmp_path: Path, lint: Lint) -> None:
    """Everything of the first package is brought in."""
    commit(tmp_path / "ws", {"README.md": "x"})
    git(tmp_path / "ws", "checkout", "-q", "-b", "first")
    commit(tmp_path / "ws", {"arm/package.xml": MANIFEST.format("arm"), "arm/src/n.cpp": declared("rate")})
    assert lint(tmp_path / "ws", "--base", "main")[0] == 0


# --- what was not read -----------------------------------------------------------------------------------------


def test_content_that_is_not_in_the_clone(parted: Path, lint: Lint) -> None:
    """Nothing found in nothing read is no answer."""
    git(parted, "config", "uploadpack.allowFilter", "true")
    clone = parted.parent / "clone"
    git(parted.parent, "clone", "-q", "--no-checkout", "--filter=blob:none", f"file://{parted}", str(clone))
    status, found, err = lint(f"{clone}@HEAD")
    assert (status, found["complete"]) == (2, False)
    assert {(each["path"], each["reason"]) for each in found["unread"]} >= {
        ("arm/package.xml", "missing"),
        ("arm/src/n.cpp", "missing"),
    }
    assert "nothing found in what could be read" in err
    assert "not read: 2 file(s) not in this clone: arm/package.xml, arm/src/n.cpp; get it with `git fetch" in err


def test_a_base_that_cannot_be_read(parted: Path, lint: Lint) -> None:
    """What changed since is not known."""
    before = git(parted, "rev-parse", "main:arm/src/n.cpp")
    git(parted, "merge", "-q", "--ff-only", "main")
    commit(parted, {"arm/src/n.cpp": declared("rate")})
    (parted / ".git" / "objects" / before[:2] / before[2:]).unlink()
    status, found, _ = lint(parted, "--base", "main")
    assert (status, found["complete"]) == (2, False)
    assert [(each["path"], each["side"]) for each in found["unread"]] == [("arm/src/n.cpp", "old")]


def test_a_change_that_leaves_a_package_out(parted: Path, lint: Lint) -> None:
    """Its interfaces are gone for who builds it, which is found; that is an answer."""
    (parted / "leg").mkdir()
    commit(parted, {"leg/package.xml": MANIFEST.format("leg")})
    (parted / "arm" / "COLCON_IGNORE").touch()
    status, found, err = lint(parted, "--base", "HEAD")
    assert (status, found["complete"]) == (0, True)
    assert "LNT019" in {each["rule"] for each in found["findings"]}
    assert "not read: 1 folder(s) left out by COLCON_IGNORE" in err


@pytest.mark.parametrize(
    ("files", "told"),
    [
        ({"arm/COLCON_IGNORE": ""}, "1 folder(s) left out by COLCON_IGNORE, CATKIN_IGNORE or AMENT_IGNORE: arm"),
        ({"ecm.toml": '[extract]\nexclude = ["arm/"]\n'}, "1 pattern(s) of `exclude` in ecm.toml: arm/"),
    ],
)
def test_what_the_project_leaves_out(tmp_path: Path, lint: Lint, files: dict[str, str], told: str) -> None:
    """Told and no failure beside what was read; of a repository that is left out as a whole there is no answer."""
    folder = tmp_path / "ws"
    commit(folder, {"arm/package.xml": MANIFEST.format("arm"), ".github/ci.yml": "on: push\n", **files})
    status, _, err = lint(folder)
    assert status == 2
    assert "holds no ROS package" in err
    assert told in err
    commit(folder, {"leg/package.xml": MANIFEST.format("leg")})
    status, found, err = lint(folder)
    assert (status, found["complete"]) == (0, True)
    assert f"not read: {told}" in err


def test_a_submodule_that_is_not_checked_out(parted: Path, lint: Lint) -> None:
    """It is another repository, which is linted by itself; it is told all the same."""
    git(parted.parent, "init", "-q", "-b", "main", "outer")
    outer = parted.parent / "outer"
    commit(outer, {"own/package.xml": MANIFEST.format("own")})
    git(outer, "submodule", "--quiet", "add", f"file://{parted}", "deps/arm")
    commit(outer, {})
    git(parted.parent, "clone", "-q", str(outer), "clone")
    status, found, err = lint(parted.parent / "clone")
    assert (status, found["complete"]) == (0, True)
    assert "not read: 1 submodule(s) not in this clone: deps/arm" in err


@pytest.mark.parametrize("files", [{}, {"README.md": "x", "LICENSE": "y"}])
def test_a_folder_without_anything(tmp_path: Path, lint: Lint, files: dict[str, str]) -> None:
    """Nothing to look at is not nothing found."""
    for path, text in files.items():
        (tmp_path / path).write_text(text)
    status, _, err = lint(tmp_path)
    assert status == 2
    assert "holds no ROS package: no package.xml or manifest.xml and no source, message or launch file" in err


# --- files of ours that a repository brings --------------------------------------------------------------------


@pytest.mark.parametrize("name", ["ecm-accepted.toml", "ecm-baseline.txt"])
def test_link_out_of_the_repository(parted: Path, tmp_path: Path, lint: Lint, name: str) -> None:
    """Neither read nor written through."""
    outside = tmp_path / "outside"
    outside.write_text("mine\n")
    (parted / name).symlink_to(outside)
    arguments = [[], ["--write-baseline"]] if name == "ecm-baseline.txt" else [[]]
    for more in arguments:
        status, _, err = lint(parted, *more)
        assert status == 2
        assert f"{name} is a symbolic link that leads out of the repository" in err
    accept = ["accept", "0" * 16, "--reason", "r", "--force", "--path", str(parted)]
    assert run(accept) == (2 if "accepted" in name else 0)
    assert outside.read_text() == "mine\n"


def test_link_into_git(parted: Path, lint: Lint) -> None:
    """The configuration of a repository is not ours either."""
    before = (parted / ".git" / "config").read_text()
    (parted / "ecm-baseline.txt").symlink_to(".git/config")
    assert lint(parted, "--write-baseline")[0] == 2
    assert (parted / ".git" / "config").read_text() == before


def test_link_inside_the_repository(parted: Path, lint: Lint) -> None:
    """Packages of one repository may share their answers."""
    (parted / "ecm-accepted.toml").write_text("")
    (parted / "arm" / "ecm-accepted.toml").symlink_to("../ecm-accepted.toml")
    assert lint(parted / "arm")[0] == 0


def two_launches(folder: Path) -> Path:
    for name in ("one", "two"):
        path = folder / "launch" / f"{name}.launch.xml"
        path.parent.mkdir(exist_ok=True)
        path.write_text("<launch/>\n")
    (folder / "package.xml").write_text(MANIFEST.format("demo"))
    return folder


def test_what_is_beyond_a_bound_is_told(tmp_path: Path, lint: Lint, monkeypatch: pytest.MonkeyPatch) -> None:
    """A run that did not judge every launch file was silent, and ended with status 0."""
    monkeypatch.setattr("ecm_extract.lint.workspace.MAX_SYSTEMS", 1)
    status, document, err = lint(two_launches(tmp_path))
    assert (status, document["findings"], document["complete"]) == (2, [], False)
    assert [(each["path"], each["reason"]) for each in document["unread"]] == [("launch/two.launch.xml", "unjudged")]
    assert "launch/two.launch.xml" in err


def test_a_rule_that_stops_leaves_the_answer_open(tmp_path: Path, lint: Lint, monkeypatch: pytest.MonkeyPatch) -> None:
    """The others are not affected, and nothing found is not nothing there."""

    def broken(_: object) -> Any:
        raise ValueError

    monkeypatch.setattr("ecm_extract.lint.workspace.evaluated_system", broken)
    status, document, _ = lint(two_launches(tmp_path))
    assert (status, document["complete"]) == (2, False)
    assert "LNT001" in [each["path"] for each in document["unread"]]
