"""What `ecm-extract lint` writes: each of its formats."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import jsonschema
import pytest
from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding
from lint_fixtures import FIXTURES, LAUNCH, run_lint
from lxml import etree

from ecm_extract.cli.outputs import findings_as
from ecm_extract.cli.run import run
from ecm_extract.report.findings.text import render, styled
from ecm_extract.report.places import Places

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


@pytest.mark.parametrize(("stand", "path", "shown"), [("ws", ".", ""), (".", "ws", "ws/"), ("ws/demo", "..", "../")])
def test_text(
    stand: str, path: str, shown: str, bad: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Place first and as it is opened from here, so that editors and terminals can jump; summary on standard error."""
    monkeypatch.chdir(bad.parent / stand)
    run_lint(path)
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
    run_lint(bad, "--format", "sarif")
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
    assert run_lint(bad, "--output", f"junit={target}") == 1
    suite = etree.fromstring(target.read_bytes())
    assert (suite.get("failures"), len(suite.findall(".//failure"))) == ("1", 1)
    assert run_lint(FIXTURES / "LNT003" / "good", "--output", f"junit={target}") == 0
    suite = etree.fromstring(target.read_bytes())
    assert (suite.get("tests"), suite.get("failures")) == ("1", "0")


@pytest.mark.parametrize("path", ["ws", "ws/demo"])
def test_a_code_host_gets_paths_from_the_root_of_the_repository(
    path: str, bad: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whatever folder is linted, and wherever from: annotations of another path are shown nowhere."""
    subprocess.run(["git", "init", "-q"], cwd=bad.parent, check=True)
    monkeypatch.chdir(bad)
    wanted = f"ws/{LAUNCH}"
    run_lint(bad.parent / path, "--format", "github")
    assert capsys.readouterr().out.startswith(f"::error file={wanted},line=2,")
    run_lint(bad.parent / path, "--format", "sarif")
    (result,) = json.loads(capsys.readouterr().out)["runs"][0]["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == wanted
    run_lint(bad.parent / path, "--format", "junit")
    assert f"{wanted}:2" in capsys.readouterr().out
    run_lint(bad.parent / path, "--format", "markdown")
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
    run_lint(bad, "--format", "github")
    assert capsys.readouterr().out.startswith(f"::error file={LAUNCH},line=2,title=LNT003 executable_missing::")
    run_lint(bad, "--format", "markdown")
    assert f"| error | `{LAUNCH}:2` | LNT003 " in capsys.readouterr().out
    run_lint(FIXTURES / "LNT003" / "good", "--format", "markdown")
    assert capsys.readouterr().out == "ecm-extract found nothing to say.\n"


def test_html(bad: Path, tmp_path: Path) -> None:
    """One page beside the text."""
    run_lint(bad, "--output", f"html={tmp_path / 'lint.html'}")
    assert "executable_missing" in (tmp_path / "lint.html").read_text("utf-8")


def test_json_has_the_wire_keys(bad: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every key of a finding."""
    run_lint(bad, "--format", "json")
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "ecm-extract/lint/1"
    needed = {"rule", "name", "dimension", "severity", "message", "resolution", "subjects", "evidence", "fingerprint"}
    assert needed <= document["findings"][0].keys()
    assert document["findings"][0]["evidence"] == [{"path": LAUNCH, "line": 2, "end_line": 2, "commit": None}]
