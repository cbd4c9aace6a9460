"""`ecm-extract lint`: formats, exit status, answers, baselines, patches."""

from __future__ import annotations

import io
import json
import shutil
from pathlib import Path

import pytest
from lint_fixtures import BAD, FIXTURES, LAUNCH, run_lint

from ecm_extract.cli.run import run


@pytest.mark.parametrize(("fail_on", "status"), [("error", 1), ("never", 0)])
def test_exit_status(fail_on: str, status: int, bad: Path) -> None:
    """Advisory mode says the same and fails nothing."""
    assert run_lint(bad, "--fail-on", fail_on) == status


@pytest.mark.parametrize(
    ("comment", "status"),
    [
        ("<!-- ecm: ignore[LNT003] started by hand -->", 0),
        ("<!-- ecm: ignore[LNT001, LNT003] started by hand -->", 0),
        ("<!-- ecm: ignore[LNT003 name=bass] started by hand -->", 0),
        ("<!-- ecm: ignore[LNT003 name=treble] started by hand -->", 1),
        ("<!-- ecm: ignore[LNT001] started by hand -->", 1),
    ],
)
def test_comment(comment: str, status: int, bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A comment answers the rules that it names; one that matches nothing is told."""
    path = bad / LAUNCH
    path.write_text(path.read_text().replace("<launch>\n", f"<launch>\n{comment}\n"))
    assert run_lint(bad) == status
    assert ("unused: " in capsys.readouterr().err) is bool(status)


def test_accept(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A row with a reason; after its day it counts again; a second row for the same is refused."""
    row = bad / "ecm-accepted.toml"
    run_lint(bad, "--format", "json")
    fingerprint = json.loads(capsys.readouterr().out)["findings"][0]["fingerprint"]
    assert run(["accept", fingerprint, "--reason", 'old "robot"', "--path", str(bad)]) == 0
    assert run_lint(bad) == 0
    assert run(["accept", fingerprint, "--reason", "again", "--path", str(bad)]) == 2
    row.write_text(row.read_text() + "until = 2020-01-01\n")
    assert run_lint(bad) == 1
    assert "was accepted until 2020-01-01" in capsys.readouterr().err
    assert run(["accept", "abc", "--reason", "x"]) == 2
    assert run(["accept", fingerprint, "--reason", "x", "--until", "soon"]) == 2


def test_accepted_file_that_is_wrong(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A misspelt key is the user's error, with the file."""
    (bad / "ecm-accepted.toml").write_text("[[accept]]\nfingerprnt = '0'\n")
    assert run_lint(bad) == 2
    assert "ecm-accepted.toml" in capsys.readouterr().err


def test_baseline(bad: Path) -> None:
    """An old repository starts clean; what comes later is reported."""
    assert run_lint(bad, "--write-baseline") == 0
    assert run_lint(bad) == 0
    path = bad / LAUNCH
    path.write_text(path.read_text().replace("</launch>", '<node pkg="demo" exec="other"/></launch>'))
    assert run_lint(bad) == 1


def test_patch(bad: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Only lines that a patch touches; what is no patch is the user's error."""
    patch = f'--- a/{LAUNCH}\n+++ b/{LAUNCH}\n@@ -1,1 +1,2 @@\n <launch>\n+  <node pkg="demo" exec="bass"/>\n'
    monkeypatch.setattr("sys.stdin", io.StringIO(patch))
    assert run_lint(bad, "--patch", "-") == 1
    monkeypatch.setattr("sys.stdin", io.StringIO(patch.replace("a.launch", "b.launch")))
    assert run_lint(bad, "--patch", "-") == 0
    monkeypatch.setattr("sys.stdin", io.StringIO("@@ -x +y @@\n"))
    assert run_lint(bad, "--patch", "-") in (0, 2)
    assert run_lint(bad, "--patch", str(bad / "none.patch")) == 2


def test_a_patch_of_one_of_several_lines(
    bad: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A cause that stands in two files is told on the line that the patch touches."""
    other = LAUNCH.replace("a.launch", "b.launch")
    (bad / other).write_text((bad / LAUNCH).read_text())
    lines = (bad / other).read_text().splitlines()
    patch = f"--- a/{other}\n+++ b/{other}\n@@ -0,0 +1,{len(lines)} @@\n" + "".join(f"+{line}\n" for line in lines)
    monkeypatch.setattr("sys.stdin", io.StringIO(patch))
    capsys.readouterr()
    assert run_lint(bad, "--patch", "-", "--format", "json") == 1
    found = json.loads(capsys.readouterr().out)["findings"]
    assert {each["evidence"][0]["path"].rpartition("/")[2] for each in found} == {other.rpartition("/")[2]}


@pytest.mark.parametrize(
    ("config", "status"),
    [
        ('[severity]\nLNT003 = "off"\n', 0),
        ('[severity]\nLNT003 = "info"\n', 0),
        ('promise = ["wire"]\n', 0),
        ('promise = ["config"]\n', 1),
    ],
)
def test_project_decides_levels_and_promises(config: str, status: int, bad: Path) -> None:
    """A rule may be silenced or lowered, and a project guards what it promises."""
    (bad / "ecm.toml").write_text(config)
    assert run_lint(bad) == status


def test_unknown_rule(bad: Path) -> None:
    """A misspelt rule selects nothing, which would look like success."""
    assert run_lint(bad, "--select", "LNT999") == 2
    assert run_lint(bad, "--select", "LNT001") == 0


@pytest.mark.parametrize("rule", ["LNT003", "LNT004", "LNT005", "LNT010", "LNT017", "LNT020"])
def test_fix(rule: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The change is shown, made, and is what makes the finding go away; a second run changes nothing."""
    folder = tmp_path / rule
    shutil.copytree(FIXTURES / rule / "bad", folder)
    run_lint(folder, "--select", rule, "--fix")
    assert "+++ b/demo/" in capsys.readouterr().err
    assert run_lint(folder, "--select", rule, "--fix", "--fail-on", "info") == 0
    assert "+++" not in capsys.readouterr().err


def test_fix_leaves_the_rest_alone(tmp_path: Path) -> None:
    """Line ends, other lines and findings without a sure correction stay."""
    folder = tmp_path / "ws"
    shutil.copytree(BAD, folder)
    path = folder / LAUNCH
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    run_lint(folder, "--fix")
    assert path.read_bytes() == b'<launch>\r\n  <node pkg="demo" exec="base"/>\r\n</launch>\r\n'


def test_fix_adds_no_dependency_to_a_comment(tmp_path: Path) -> None:
    """A dependency goes behind the last one that holds, which ends on its line."""
    folder = tmp_path / "ws"
    shutil.copytree(FIXTURES / "LNT004" / "bad", folder)
    path = folder / "demo" / "package.xml"
    aside = "  <!--\n  <depend>old</depend>\n  -->\n  <exec_depend>\n    xacro\n  </exec_depend>\n</package>"
    path.write_text(path.read_text().replace("</package>", aside))
    run_lint(folder, "--select", "LNT004", "--fix")
    assert aside in path.read_text()
    assert run_lint(folder, "--select", "LNT004", "--fail-on", "info") == 0


def test_statistics(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """How much there is of what, and how much of it mends itself; the status is that of the findings."""
    assert run_lint(bad, "--statistics") == 1
    out, err = capsys.readouterr()
    assert out.splitlines()[0].split() == ["count", "fixable", "rule"]
    assert [line.split()[2] for line in out.splitlines()[1:]] == ["LNT003"]
    assert "1 error" in err
    assert run_lint(bad, "--statistics", "--format", "json") == 1
    (row,) = json.loads(capsys.readouterr().out)["rules"]
    assert row == {"rule": "LNT003", "name": row["name"], "count": 1, "fixable": row["fixable"]}


def test_statistics_of_a_format_for_findings(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """SARIF has no place for counts."""
    assert run_lint(bad, "--statistics", "--format", "sarif") == 2
    assert "text or json" in capsys.readouterr().err


def test_a_comment_names_its_rule_in_any_case(bad: Path) -> None:
    """`ecm: ignore[lnt003]` was read as nothing."""
    path = bad / LAUNCH
    path.write_text(path.read_text().replace("<node", "<!-- ecm: ignore[lnt003] on purpose -->\n<node"))
    assert run_lint(bad, "--select", "lnt003") == 0


def test_preview_rules_wait_for_their_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What did not run is said: nothing found is not nothing there."""
    shutil.copytree(FIXTURES / "LNT016" / "bad", tmp_path / "ws")
    assert run(["lint", str(tmp_path / "ws"), "--fail-on", "info"]) == 0
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "preview rules did not run" in captured.err
    assert run(["lint", str(tmp_path / "ws"), "--fail-on", "info", "--preview"]) == 1
    captured = capsys.readouterr()
    assert "LNT016" in captured.out
    assert "preview" not in captured.err


def test_a_preview_rule_by_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Neither run by chance nor left out in silence."""
    shutil.copytree(FIXTURES / "LNT016" / "bad", tmp_path / "ws")
    assert run(["lint", str(tmp_path / "ws"), "--select", "LNT016"]) == 2
    assert "add --preview" in capsys.readouterr().err


def test_rules_are_listed_with_their_tier(capsys: pytest.CaptureFixture[str]) -> None:
    """A stable rule has no mark."""
    assert run(["rules"]) == 0
    lines = {line[:6]: line for line in capsys.readouterr().out.splitlines()}
    assert lines["LNT016"].endswith("(preview)")
    assert not lines["LNT004"].endswith("(preview)")
