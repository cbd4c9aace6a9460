"""Every lint rule has a page, fires on its bad fixture and is quiet on the good twin; all over all is one file."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest
from lint_fixtures import FIXTURES, ROOT, lint

from ecm_extract.cli.run import run
from ecm_extract.lint.catalogue import catalogue
from ecm_extract.lint.rule import Entry

ENTRIES = {entry.rule.id: entry for entry in catalogue()}
WITHOUT_FIXTURE = {"LNT019", "LNT030"}
"""Shown by two commits, not by a folder: see test_lint_base."""


@pytest.mark.parametrize("rule", ENTRIES)
def test_file_is_named_after_the_id(rule: str) -> None:
    """A rule is found where its id says."""
    assert importlib.import_module(f"ecm_extract.lint.rules.{rule.lower()}").RULE.id == rule


def test_no_page_or_fixture_without_a_rule() -> None:
    """What is left of a rule that is gone is removed."""
    assert {path.stem for path in (ROOT / "docs" / "rules").glob("LNT*.md")} == set(ENTRIES)
    assert {path.name for path in FIXTURES.iterdir()} == ENTRIES.keys() - WITHOUT_FIXTURE


@pytest.mark.parametrize("entry", ENTRIES.values(), ids=ENTRIES)
def test_page(entry: Entry) -> None:
    """`explain` prints the page, which says what the rule says and how it is silenced."""
    rule = entry.rule
    page = (ROOT / "docs" / "rules" / f"{rule.id}.md").read_text("utf-8")
    assert page.startswith(f"# {rule.id} {rule.name}\n")
    assert f"| {rule.dimension} | {rule.severity} | {rule.who} |" in page
    for heading in ("What the robot does", "How to fix it", "When it is quiet", "How to silence it", "Bad", "Good"):
        assert f"## {heading}" in page
    assert rule.resolution[-1] != "."


@pytest.mark.parametrize("rule", sorted(ENTRIES.keys() - WITHOUT_FIXTURE))
def test_bad_fires_and_good_is_quiet(rule: str, apart: Path) -> None:
    """The two differ in what the rule is about and in nothing else."""
    assert rule in [finding.rule for finding in lint(apart / rule / "bad")]
    assert rule not in [finding.rule for finding in lint(apart / rule / "good")]


def test_all_rules_over_all_fixtures(golden: object, apart: Path) -> None:
    """A rule that speaks up on the fixture of another is seen in review; good twins are quiet altogether."""
    lines = []
    for folder in sorted(apart.glob("*/*")):
        lines.append(f"{folder.relative_to(apart)}")
        for finding in lint(folder):
            place = finding.evidence[0]
            lines.append(
                f"  {finding.severity} {finding.certainty} {finding.rule} {place.path}:{place.line} {finding.message}"
            )
            lines.append(f"    fix: {finding.resolution}  [{finding.fingerprint}]")
        if folder.name == "good":
            assert lines[-1] == f"{folder.relative_to(apart)}"
    golden("lint_rules.txt", "\n".join(lines) + "\n")  # type: ignore[operator]


@pytest.mark.parametrize("folder", ["demo_robot", "arm_robot"])
def test_our_own_robots_are_clean(folder: str) -> None:
    """What shows how things are done has no errors."""
    assert [finding.message for finding in lint(ROOT / "fixtures" / folder) if finding.severity == "error"] == []


def test_rules_and_explain(capsys: pytest.CaptureFixture[str]) -> None:
    """Every rule is listed, and the page of any of them is printed."""
    assert run(["rules"]) == 0
    listed = capsys.readouterr().out
    assert all(rule in listed for rule in (*ENTRIES, "RES001", "SIG001"))
    assert run(["explain", "lnt005"]) == 0
    assert capsys.readouterr().out.startswith("# LNT005")
    assert run(["explain", "LNT999"]) == 2


def test_fingerprint_survives_a_moved_line(tmp_path: Path) -> None:
    """A comment above the line changes nothing that a person has accepted."""
    for number, head in enumerate(("", "<!-- new -->\n\n")):
        source = FIXTURES / "LNT003" / "bad"
        for path in source.rglob("*"):
            if path.is_file():
                target = tmp_path / str(number) / path.relative_to(source)
                target.parent.mkdir(parents=True, exist_ok=True)
                text = path.read_text()
                target.write_text(text.replace("<launch>\n", f"<launch>\n{head}"))
    one, two = (lint(tmp_path / str(number))[0] for number in (0, 1))
    assert one.fingerprint == two.fingerprint
    assert one.evidence[0].line + 2 == two.evidence[0].line
