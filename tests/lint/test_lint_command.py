"""`ecm-extract lint`: formats, exit status, answers, baselines, patches."""

from __future__ import annotations

import io
import json
import re
import shutil
import subprocess
from pathlib import Path

import jsonschema
import pytest
from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding
from lint_fixtures import FIXTURES
from lxml import etree

from ecm_extract.cli.outputs import findings_as
from ecm_extract.cli.run import run
from ecm_extract.report.findings.text import render, styled
from ecm_extract.report.places import Places

BAD = FIXTURES / "LNT003" / "bad"
LAUNCH = "demo/launch/a.launch.xml"
SARIF = {
    "type": "object",
    "required": ["version", "runs"],
    "properties": {
        "version": {"const": "2.1.0"},
        "runs": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["tool", "results"],
                "properties": {
                    "tool": {"type": "object", "required": ["driver"]},
                    "results": {
                        "type": "array",
                        "items": {
                            "type": "object",
                            "required": ["message", "ruleId", "level", "locations"],
                            "properties": {"level": {"enum": ["none", "note", "warning", "error"]}},
                        },
                    },
                },
            },
        },
    },
}
"""The parts of the SARIF 2.1.0 schema that a code host needs."""


@pytest.fixture
def bad(tmp_path: Path) -> Path:
    shutil.copytree(BAD, tmp_path / "ws")
    return tmp_path / "ws"


def git(folder: Path, *arguments: str) -> None:
    subprocess.run(["git", *arguments], cwd=folder, check=True)


def lint(*arguments: str | Path) -> int:
    return run(["lint", "--preview", *map(str, arguments)])


@pytest.mark.parametrize(("fail_on", "status"), [("error", 1), ("never", 0)])
def test_exit_status(fail_on: str, status: int, bad: Path) -> None:
    """Advisory mode says the same and fails nothing."""
    assert lint(bad, "--fail-on", fail_on) == status


@pytest.mark.parametrize(("stand", "path", "shown"), [("ws", ".", ""), (".", "ws", "ws/"), ("ws/demo", "..", "../")])
def test_text(
    stand: str, path: str, shown: str, bad: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Place first and as it is opened from here, so that editors and terminals can jump; summary on standard error."""
    monkeypatch.chdir(bad.parent / stand)
    lint(path)
    captured = capsys.readouterr()
    assert captured.out.startswith(f"{shown}{LAUNCH}:2: error LNT003 executable_missing: ")
    assert '    2 |   <node pkg="demo" exec="bass"/>\n' in captured.out
    assert "fix: write base" in captured.out
    assert captured.err.strip() == "1 error"


def test_info_takes_one_line(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What may be known already does not push aside what breaks somebody; its fingerprint is there to accept it."""
    (bad / "ecm.toml").write_text('[severity]\nLNT003 = "info"\n')
    assert run(["lint", "--preview", str(bad)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1
    assert re.match(rf"{bad}/{LAUNCH}:\d+: info LNT003 .* \[[0-9a-f]{{16}}\]$", lines[0])


def _finding(message: str, place: Evidence) -> Finding:
    return Finding(
        rule="X",
        name="name",
        dimension="signature",
        severity="error",
        message=message,
        resolution="fix",
        subjects=(),
        evidence=(place,),
        fingerprint="0" * 16,
        who="config",
        certainty="proved",
    )


def test_a_finding_cannot_color_the_terminal() -> None:
    """Only the tool writes escape codes, and to a terminal only."""
    finding = _finding("\x1b[35mred", Evidence("a\x1b[1m", 1))
    assert "\x1b[" in styled([finding])
    assert "\x1b[35m" not in styled([finding])
    assert "\x1b" not in render([finding])


def test_sarif(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Valid, with place, fingerprint and rule."""
    lint(bad, "--format", "sarif")
    document = json.loads(capsys.readouterr().out)
    jsonschema.validate(document, SARIF)
    (result,) = document["runs"][0]["results"]
    place = result["locations"][0]["physicalLocation"]
    assert (place["artifactLocation"]["uri"], place["region"]["startLine"]) == (LAUNCH, 2)
    assert len(result["partialFingerprints"]["ecmExtract/v1"]) == 16
    (rule,) = document["runs"][0]["tool"]["driver"]["rules"]
    assert rule["id"] == "LNT003"
    assert rule["help"]["markdown"].startswith("# LNT003")


def test_junit(bad: Path, tmp_path: Path) -> None:
    """An error is a failure; a clean workspace is one test that passed."""
    target = tmp_path / "out.xml"
    assert lint(bad, "--output", f"junit={target}") == 1
    suite = etree.fromstring(target.read_bytes())
    assert (suite.get("failures"), len(suite.findall(".//failure"))) == ("1", 1)
    assert lint(FIXTURES / "LNT003" / "good", "--output", f"junit={target}") == 0
    suite = etree.fromstring(target.read_bytes())
    assert (suite.get("tests"), suite.get("failures")) == ("1", "0")


@pytest.mark.parametrize("path", ["ws", "ws/demo"])
def test_a_code_host_gets_paths_from_the_root_of_the_repository(
    path: str, bad: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whatever folder is linted, and wherever from: annotations of another path are shown nowhere."""
    git(bad.parent, "init", "-q")
    monkeypatch.chdir(bad)
    wanted = f"ws/{LAUNCH}"
    lint(bad.parent / path, "--format", "github")
    assert capsys.readouterr().out.startswith(f"::error file={wanted},line=2,")
    lint(bad.parent / path, "--format", "sarif")
    (result,) = json.loads(capsys.readouterr().out)["runs"][0]["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == wanted
    lint(bad.parent / path, "--format", "junit")
    assert f"{wanted}:2" in capsys.readouterr().out
    lint(bad.parent / path, "--format", "markdown")
    assert f"`{wanted}:2`" in capsys.readouterr().out


@pytest.mark.parametrize("form", ["sarif", "github", "junit"])
def test_a_known_column_is_told(form: str) -> None:
    """Code hosts mark the place in the line."""
    text = findings_as(form, [_finding("said.", Evidence("a.yaml", 3, column=7))], Places())
    assert {"sarif": '"startColumn": 7', "github": "line=3,col=7,", "junit": "a.yaml:3:7"}[form] in text
    assert "said. fix." in text


def test_text_marks_the_column() -> None:
    """The line that was read, and a mark below the place; tabs do not move it."""
    places = Places(line=lambda _: "\ta: bass")
    lines = render([_finding("said", Evidence("a.yaml", 3, column=5))], places).splitlines()
    assert lines[0].startswith("a.yaml:3:5: error X name: said")
    assert lines[1:3] == ["    3 |         a: bass", "      |            ^"]


def test_github_and_markdown(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A workflow command on the line; a table for the comment."""
    lint(bad, "--format", "github")
    assert capsys.readouterr().out.startswith(f"::error file={LAUNCH},line=2,title=LNT003 executable_missing::")
    lint(bad, "--format", "markdown")
    assert f"| error | `{LAUNCH}:2` | LNT003 " in capsys.readouterr().out
    lint(FIXTURES / "LNT003" / "good", "--format", "markdown")
    assert capsys.readouterr().out == "ecm-extract found nothing to say.\n"


def test_html(bad: Path, tmp_path: Path) -> None:
    """One page beside the text."""
    lint(bad, "--output", f"html={tmp_path / 'lint.html'}")
    assert "executable_missing" in (tmp_path / "lint.html").read_text("utf-8")


def test_json_has_the_wire_keys(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every key of a finding."""
    lint(bad, "--format", "json")
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "ecm-extract/lint/1"
    needed = {"rule", "name", "dimension", "severity", "message", "resolution", "subjects", "evidence", "fingerprint"}
    assert needed <= document["findings"][0].keys()
    assert document["findings"][0]["evidence"] == [{"path": LAUNCH, "line": 2, "end_line": 2, "commit": None}]


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
    assert lint(bad) == status
    assert ("unused: " in capsys.readouterr().err) is bool(status)


def test_accept(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A row with a reason; after its day it counts again; a second row for the same is refused."""
    row = bad / "ecm-accepted.toml"
    lint(bad, "--format", "json")
    fingerprint = json.loads(capsys.readouterr().out)["findings"][0]["fingerprint"]
    assert run(["accept", fingerprint, "--reason", 'old "robot"', "--path", str(bad)]) == 0
    assert lint(bad) == 0
    assert run(["accept", fingerprint, "--reason", "again", "--path", str(bad)]) == 2
    row.write_text(row.read_text() + "until = 2020-01-01\n")
    assert lint(bad) == 1
    assert "was accepted until 2020-01-01" in capsys.readouterr().err
    assert run(["accept", "abc", "--reason", "x"]) == 2
    assert run(["accept", fingerprint, "--reason", "x", "--until", "soon"]) == 2


def test_accepted_file_that_is_wrong(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A misspelt key is the user's error, with the file."""
    (bad / "ecm-accepted.toml").write_text("[[accept]]\nfingerprnt = '0'\n")
    assert lint(bad) == 2
    assert "ecm-accepted.toml" in capsys.readouterr().err


def test_baseline(bad: Path) -> None:
    """An old repository starts clean; what comes later is reported."""
    assert lint(bad, "--write-baseline") == 0
    assert lint(bad) == 0
    path = bad / LAUNCH
    path.write_text(path.read_text().replace("</launch>", '<node pkg="demo" exec="other"/></launch>'))
    assert lint(bad) == 1


def test_patch(bad: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Only lines that a patch touches; what is no patch is the user's error."""
    patch = f'--- a/{LAUNCH}\n+++ b/{LAUNCH}\n@@ -1,1 +1,2 @@\n <launch>\n+  <node pkg="demo" exec="bass"/>\n'
    monkeypatch.setattr("sys.stdin", io.StringIO(patch))
    assert lint(bad, "--patch", "-") == 1
    monkeypatch.setattr("sys.stdin", io.StringIO(patch.replace("a.launch", "b.launch")))
    assert lint(bad, "--patch", "-") == 0
    monkeypatch.setattr("sys.stdin", io.StringIO("@@ -x +y @@\n"))
    assert lint(bad, "--patch", "-") in (0, 2)
    assert lint(bad, "--patch", str(bad / "none.patch")) == 2


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
    assert lint(bad, "--patch", "-", "--format", "json") == 1
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
    assert lint(bad) == status


def test_unknown_rule(bad: Path) -> None:
    """A misspelt rule selects nothing, which would look like success."""
    assert lint(bad, "--select", "LNT999") == 2
    assert lint(bad, "--select", "LNT001") == 0


@pytest.mark.parametrize("rule", ["LNT003", "LNT004", "LNT005", "LNT010", "LNT017", "LNT020"])
def test_fix(rule: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The change is shown, made, and is what makes the finding go away; a second run changes nothing."""
    folder = tmp_path / rule
    shutil.copytree(FIXTURES / rule / "bad", folder)
    lint(folder, "--select", rule, "--fix")
    assert "+++ b/demo/" in capsys.readouterr().err
    assert lint(folder, "--select", rule, "--fix", "--fail-on", "info") == 0
    assert "+++" not in capsys.readouterr().err


def test_fix_leaves_the_rest_alone(tmp_path: Path) -> None:
    """Line ends, other lines and findings without a sure correction stay."""
    folder = tmp_path / "ws"
    shutil.copytree(BAD, folder)
    path = folder / LAUNCH
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    lint(folder, "--fix")
    assert path.read_bytes() == b'<launch>\r\n  <node pkg="demo" exec="base"/>\r\n</launch>\r\n'


def test_statistics(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """How much there is of what, and how much of it mends itself; the status is that of the findings."""
    assert lint(bad, "--statistics") == 1
    out, err = capsys.readouterr()
    assert out.splitlines()[0].split() == ["count", "fixable", "rule"]
    assert [line.split()[2] for line in out.splitlines()[1:]] == ["LNT003"]
    assert "1 error" in err
    assert lint(bad, "--statistics", "--format", "json") == 1
    (row,) = json.loads(capsys.readouterr().out)["rules"]
    assert row == {"rule": "LNT003", "name": row["name"], "count": 1, "fixable": row["fixable"]}


def test_statistics_of_a_format_for_findings(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """SARIF has no place for counts."""
    assert lint(bad, "--statistics", "--format", "sarif") == 2
    assert "text or json" in capsys.readouterr().err


def test_a_comment_names_its_rule_in_any_case(bad: Path) -> None:
    """`ecm: ignore[lnt003]` was read as nothing."""
    path = bad / LAUNCH
    path.write_text(path.read_text().replace("<node", "<!-- ecm: ignore[lnt003] on purpose -->\n<node"))
    assert lint(bad, "--select", "lnt003") == 0


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
