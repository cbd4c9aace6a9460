"""Every rule of observation has a page, fires on its bad fixture and is quiet on the good twin."""

from __future__ import annotations

import importlib
from typing import Protocol

import pytest
from observe_fixtures import ROOT, RULES, load

from ecm_extract.observe.catalogue import catalogue
from ecm_extract.observe.compare import compare
from ecm_extract.observe.rule import Entry

ENTRIES = {entry.rule.id: entry for entry in catalogue()}


class Checks(Protocol):
    def __call__(self, name: str, text: str) -> None: ...


@pytest.mark.parametrize("rule", ENTRIES)
def test_file_is_named_after_the_id(rule: str) -> None:
    """A rule is found where its id says."""
    assert importlib.import_module(f"ecm_extract.observe.rules.{rule.lower()}").RULE.id == rule


def test_no_page_or_fixture_without_a_rule() -> None:
    """What is left of a rule that is gone is removed."""
    assert {path.stem for path in (ROOT / "docs" / "rules").glob("OBS*.md")} == set(ENTRIES)
    assert {path.name for path in RULES.iterdir()} == set(ENTRIES)


@pytest.mark.parametrize("entry", ENTRIES.values(), ids=ENTRIES)
def test_page(entry: Entry) -> None:
    """`explain` prints the page, which says what the rule says and shows the fixtures as they are."""
    rule = entry.rule
    page = (ROOT / "docs" / "rules" / f"{rule.id}.md").read_text("utf-8")
    assert page.startswith(f"# {rule.id} {rule.name}\n")
    assert f"| {rule.dimension} | {rule.severity} | {rule.who} |" in page
    assert rule.consequence[1:] in page
    assert rule.resolution[1:] in page
    assert "## When it is quiet" in page
    for side in ("bad", "good"):
        assert (RULES / rule.id / f"{side}.yaml").read_text("utf-8") in page


@pytest.mark.parametrize("rule", ENTRIES)
def test_bad_fires_and_good_is_quiet(rule: str) -> None:
    """The two differ in what the rule is about and in nothing else; good twins are quiet altogether."""
    assert rule in [finding.rule for finding in compare(load(RULES / rule / "bad.yaml"))]
    assert compare(load(RULES / rule / "good.yaml")) == ()


def test_all_rules_over_all_fixtures(golden: Checks) -> None:
    """What each rule says of the fixtures of the others is seen in review."""
    lines = []
    for rule in sorted(ENTRIES):
        lines.append(f"{rule}/bad")
        lines += [
            f"  {each.rule} {each.severity} {each.certainty} {each.message} [{each.fingerprint}]"
            for each in compare(load(RULES / rule / "bad.yaml"))
        ]
    golden("observe_rules.txt", "\n".join(lines) + "\n")
