"""The catalogue of rules: every rule has a page, a bad fixture on which it fires and a good twin."""

from __future__ import annotations

import importlib
import re
from pathlib import Path
from typing import Protocol

import pytest
from ecm_checker.case import Case
from ecm_checker.catalogue import catalogue
from ecm_checker.finding import Finding
from ecm_checker.operations.engine import findings
from ecm_checker.operations.table import OPERATIONS
from ecm_checker.rule import Entry
from ecm_checker.view import view
from rule_fixtures import ROOT, RULES, contract, said

ENTRIES = {entry.rule.id: entry for entry in catalogue()}


class Checks(Protocol):
    def __call__(self, name: str, text: str) -> None: ...


@pytest.mark.parametrize("rule", ENTRIES)
def test_file_is_named_after_the_id(rule: str) -> None:
    """A rule is found where its id says."""
    module = importlib.import_module(f"ecm_checker.rules.{rule.lower()}")
    assert module.RULE.id == rule
    assert re.fullmatch(r"(SIG|BEH|RES|PERM|REC|VER)\d{3}", rule)


@pytest.mark.parametrize("rule", ENTRIES)
def test_prefix_says_the_dimension(rule: str) -> None:
    """Ids are grouped by dimension."""
    assert ENTRIES[rule].rule.dimension[:3].upper() == rule[:3]


@pytest.mark.parametrize("entry", ENTRIES.values(), ids=ENTRIES)
def test_rule_is_consulted_and_explained(entry: Entry) -> None:
    """Some operation consults it; consequence and resolution read as parts of a sentence."""
    rule = entry.rule
    rows = [
        row
        for row in OPERATIONS.values()
        if rule.dimension in row.dimensions and set(row.sub_checks) & set(rule.part_of)
    ]
    assert rows
    assert rule.consequence
    assert rule.resolution
    assert rule.resolution[-1] != "."


@pytest.mark.parametrize("entry", ENTRIES.values(), ids=ENTRIES)
def test_page_exists(entry: Entry) -> None:
    """`explain` prints the page; it names the rule and says what it says."""
    page = (ROOT / "docs" / "rules" / f"{entry.rule.id}.md").read_text("utf-8")
    assert page.startswith(f"# {entry.rule.id} {entry.rule.name}\n")
    assert entry.rule.consequence[1:] in page
    assert entry.rule.resolution[1:] in page
    assert "## Bad" in page
    assert "## Good" in page


def test_no_page_or_fixture_without_a_rule() -> None:
    """What is left of a rule that is gone is removed."""
    pages = {path.stem for path in (ROOT / "docs" / "rules").glob("*.md")}
    assert {page for page in pages if not page.startswith(("LNT", "OBS"))} - {"VER001"} == set(ENTRIES)
    assert {path.name for path in RULES.iterdir()} == set(ENTRIES)


@pytest.mark.parametrize("rule", ENTRIES)
def test_bad_fires_and_good_twin_is_quiet(rule: str) -> None:
    """The rule tells the two apart."""
    assert [each for each in said(RULES / rule / "bad") if each.rule == rule]
    assert not [each for each in said(RULES / rule / "good") if each.rule == rule]


def shown(found: Finding) -> str:
    """The message, but not of what nearly every fixture lacks."""
    return "" if found.rule == "VER005" else f": {found.message}"


def test_every_rule_over_every_fixture(golden: Checks) -> None:
    """What each rule says of the fixtures of the others is seen in review."""
    lines = []
    for rule in sorted(ENTRIES):
        for side in ("bad", "good"):
            lines.append(f"{rule}/{side}")
            lines += [
                f"  {each.rule} {each.severity} {each.certainty} {' '.join(each.subjects)}{shown(each)}"
                for each in said(RULES / rule / side)
            ]
    golden("rules.txt", "\n".join(lines) + "\n")


@pytest.mark.parametrize("path", sorted(RULES.rglob("*.ecm.yaml")), ids=lambda path: "/".join(path.parts[-3:]))
def test_a_version_compared_with_itself_is_silent(path: Path) -> None:
    """Nothing changed, so no rule about changes speaks."""
    same = view(contract(path))
    deltas = [
        entry
        for entry in catalogue()
        if {"DepPreserve", "PermDeltaSafe", "ResDeltaSafe", "RecDeltaSafe"} & set(entry.rule.part_of)
        and entry.rule.id != "VER004"
    ]
    assert not findings(Case((same,), previous=same), deltas)
