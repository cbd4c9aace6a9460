"""`ecm-extract diff` over real repositories: what changed, who breaks, and who is quiet."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release, write
from git_repos import git
from released_arm import CONSUMER, document, ran

from ecm_extract.cli.run import run


def test_every_kind_of_change_is_told(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each difference of the two releases is one change, and nothing else is."""
    found = document(capsys, "1.0.0", "1.1.0", "--repo", repo)
    told = {(c["kind"], c["change"], c["old"], c["new"], c["breaking"]) for c in found["changes"]}
    assert told == {
        ("parameter", "renamed", "checker_plugin", "checker_plugins", True),
        ("parameter", "type_changed", "checker_plugin", "checker_plugins", True),
        ("parameter", "default_changed", "checker_plugin", "checker_plugins", False),
        ("parameter", "default_changed", "rate", "rate", False),
        ("topic", "renamed", "~/state/joints", "~/joint_state/raw/joints", True),
        ("service", "removed", "~/home", None, True),
        ("method", "signature_changed", "start", "start", True),
        ("message_field", "renamed", "force", "max_force", True),
        ("message", "removed", "arm_msgs/srv/Go", None, True),
        ("message", "signature_changed", "arm_msgs/msg/Plan", "arm_msgs/msg/Plan", True),
    }


def test_the_document_is_the_wire_format(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Other programs read these keys."""
    found = document(capsys, "1.0.0", "1.1.0", "--repo", repo)
    assert found["schema"] == "ecm-extract/diff/1"
    assert found["repo"] == "arm"
    assert found["old"] == {"ref": "1.0.0", "commit": git(repo, "rev-parse", "1.0.0")}
    assert set(found["changes"][0]) == {
        "kind", "change", "package", "owner", "old", "new", "breaking", "dimension", "confidence", "reason",
        "evidence_old", "evidence_new", "old_value", "new_value", "fingerprint", "accepted", "cause",
    }  # fmt: skip
    verdict = {"compatibility_class": "breaking", "required_bump": "major", "declared_bump": "minor", "complete": True}
    assert found["verdict"] == verdict
    assert found["unread"] == []


@pytest.mark.parametrize("ref", ["1.0.0", "1.1.0"])
def test_a_release_equals_itself(repo: Path, ref: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Every state compared with itself is empty."""
    assert document(capsys, ref, ref, "--repo", repo)["changes"] == []


def test_the_baseline_is_the_newest_release_behind(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Without OLD it is the newest reachable tag, and standard error says which and why."""
    _, _, err = ran(capsys, "--repo", repo)
    commit = git(repo, "rev-parse", "1.0.0")[:12]
    assert f"baseline: 1.0.0 {commit} (newest release tag reachable from HEAD)" in err


def test_folders_are_compared_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Neither side has to be in a repository."""
    for name, field in (("a", "x"), ("b", "y")):
        write(tmp_path / name, {"package.xml": package("p"), "msg/M.msg": f"float64 {field}\nbool keep\n"})
    found = document(capsys, tmp_path / "a", tmp_path / "b", "--repo", tmp_path)
    assert {c["kind"] for c in found["changes"]} == {"message_field"}


def test_two_folders_are_two_states_of_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What tells no name of its own is called alike in both, however the folders are called."""
    for name in ("before", "after"):
        (tmp_path / name / "scripts").mkdir(parents=True)
        (tmp_path / name / "manifest.xml").write_text("<package><author>A</author></package>\n")
    assert run(["diff", str(tmp_path / "before"), str(tmp_path / "after"), "--format", "json"]) == 0
    assert not json.loads(capsys.readouterr().out)["changes"]


def test_a_bare_word_may_be_a_folder(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where no ref of the name is, the folder beside it is meant; what is in no commit is said to be."""
    for name in ("before", "after"):
        write(tmp_path / name, {"package.xml": package("p"), "msg/M.msg": f"float64 {name}\nbool keep\n"})
    monkeypatch.chdir(tmp_path)
    _, out, err = ran(capsys, "before", "after")
    assert "message field p/msg/M: before" in out
    assert "baseline: before files in no commit (named)" in err


def told(found: dict[str, Any]) -> dict[str, Any]:
    """A comparison without how its sides are called."""
    return {key: value for key, value in found.items() if key not in {"old", "new"}}


@pytest.mark.parametrize("kept", [{"old"}, {"new"}, {"old", "new"}, {"old", "new", "consumer"}], ids=sorted)
@pytest.mark.parametrize("form", ["folder", "document"])
def test_stored_documents_tell_what_sources_tell(
    repo: Path, tmp_path: Path, kept: set[str], form: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Changes, findings and lines are the same, whichever of the sides and consumers is a document."""
    write(tmp_path / "ws", dict(CONSUMER))
    sources = {"old": f"{repo}@1.0.0", "new": f"{repo}@1.1.0", "consumer": str(tmp_path / "ws")}
    places = {side: stored(tmp_path, side, path, form) if side in kept else path for side, path in sources.items()}
    expected = document(capsys, "1.0.0", "1.1.0", "--repo", repo, "--consumer", tmp_path / "ws")
    found = document(capsys, places["old"], places["new"], "--repo", repo, "--consumer", places["consumer"])
    assert told(found) == told(expected)
    assert "VER001" in {finding["rule"] for finding in found["findings"]}


def stored(folder: Path, side: str, path: str, form: str) -> str:
    """Extract a side into a folder of manifests and documents, or one document; return where it is."""
    place = folder / "kept" / side
    form_arguments = ["-o", str(place)] if form == "folder" else ["--format", "json", "-o", str(place)]
    assert run(["extract", path, *form_arguments, "-q"]) == 0
    return str(place if form == "folder" else place / "extract.json")


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("p/p.package.json", '{"schema": "ecm-extract/package/0"}', "ecm-extract/package/0"),
        ("p/p.package.json", '{"schema": "ecm-extract/package/1"}', "missing required field"),
        ("p/p.package.json", "[", "p.package.json"),
        ("p/ecm.p.node.ecm.yaml", "schema: ecm-extract/manifest/1\n", "no document of a package"),
    ],
)
def test_a_document_that_cannot_be_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, content: str, said: str
) -> None:
    """It is named, with what is wrong, and a number of another schema is told."""
    write(tmp_path / "contracts", {name: content})
    status, out, err = ran(capsys, tmp_path / "contracts", tmp_path / "contracts", "--repo", tmp_path)
    assert (status, out) == (2, "")
    assert said in err


def test_an_unknown_ref_is_an_input_error(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Status 2, with what to do about it, and no traceback."""
    status, out, err = ran(capsys, "9.9.9", "1.1.0", "--repo", repo)
    assert (status, out) == (2, "")
    assert "check the spelling" in err


@pytest.mark.parametrize(("fail_on", "status"), [("error", 1), ("breaking", 1), ("never", 0)])
def test_the_status_follows_the_threshold(
    repo: Path, tmp_path: Path, fail_on: str, status: int, capsys: pytest.CaptureFixture[str]
) -> None:
    """A person picks what stops a build."""
    write(tmp_path / "ws", dict(CONSUMER))
    args = ("1.0.0", "1.1.0", "--repo", repo, "--consumer", tmp_path / "ws", "--fail-on", fail_on)
    assert ran(capsys, *args)[0] == status


def test_a_deprecated_parameter_is_no_break(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A kept old name is `deprecated`; its removal in the next release is a rename to the successor."""
    folder = tmp_path / "r"
    warn = 'RCLCPP_WARN(get_logger(), "\\"speed\\" is deprecated, use \\"max_speed\\" instead");'
    both = ('declare_parameter("speed", 1.0);', 'declare_parameter("max_speed", 1.0);')
    release(folder, {"package.xml": package("p"), "src/a.cpp": node(both[0])}, "1.0.0")
    release(folder, {"src/a.cpp": node(*both, warn)}, "1.1.0")
    release(folder, {"src/a.cpp": node(both[1])}, "2.0.0")
    first = document(capsys, "1.0.0", "1.1.0", "--repo", folder)["changes"]
    assert [(c["change"], c["old"]) for c in first if c["old"]] == [("deprecated", "speed")]
    assert not any(c["breaking"] for c in first)
    second = document(capsys, "1.1.0", "2.0.0", "--repo", folder)["changes"]
    assert [(c["change"], c["old"], c["new"]) for c in second] == [("renamed", "speed", "max_speed")]


def test_backport_is_one_line(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """REP 2004 in one line."""
    out = ran(capsys, "1.0.0", "1.1.0", "--repo", repo, "--backport")[1]
    assert re.fullmatch(r"backport: no, \d+ breaking changes?;.*\n", out)


@pytest.mark.parametrize("form", ["text", "migration", "markdown", "html"])
def test_reports_for_people(
    repo: Path,
    tmp_path: Path,
    form: str,
    golden: Any,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What people read is seen in review."""
    write(tmp_path / "ws", dict(CONSUMER))
    monkeypatch.chdir(tmp_path)
    args = ("1.0.0", "1.1.0", "--repo", repo.name, "--consumer", "ws", "--format", form)
    golden(f"diff_{form}.txt", ran(capsys, *args)[1])
