"""Ids of rules, wherever a person writes one."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ecm_extract.cli.run import run
from ecm_extract.config import parse_config
from ecm_extract.errors import InputError
from ecm_extract.rule_ids import rule_named, rules_meant
from ecm_extract.rule_pages import lint_rule_ids, rule_names

KNOWN = ("LNT001", "LNT002", "LNT010", "VER001")


@pytest.mark.parametrize(
    ("texts", "meant"),
    [
        (["lnt001"], {"LNT001"}),
        (["LNT00"], {"LNT001", "LNT002"}),
        (["lnt0", "ver"], set(KNOWN)),
        ([" VER001 "], {"VER001"}),
        ([], set()),
    ],
)
def test_ids_and_their_beginnings(texts: list[str], meant: set[str]) -> None:
    """In any case, and several by what they have in common."""
    assert rules_meant(texts, KNOWN) == meant


@pytest.mark.parametrize("text", ["", " ", "LNT9", "NT001", "LNT0010"])
def test_what_means_no_rule_is_refused(text: str) -> None:
    """It would select nothing, which looks like success."""
    with pytest.raises(InputError, match="there is no rule"):
        rules_meant([text], KNOWN)
    with pytest.raises(InputError, match="there is no rule"):
        rule_named(text, KNOWN)


@given(st.sampled_from(sorted(rule_names())), st.data())
def test_case_means_nothing(rule: str, data: st.DataObject) -> None:
    """Of any rule."""
    text = "".join(data.draw(st.sampled_from([char.lower(), char.upper()])) for char in rule)
    assert rule_named(text, rule_names()) == rule
    assert rules_meant([text], rule_names()) == {rule}


def test_an_id_is_not_the_beginning_of_another() -> None:
    """Or selecting one rule would bring in a second one."""
    assert not [(one, two) for one in rule_names() for two in rule_names() if one != two and two.startswith(one)]


def test_lint_selects_the_breaks_of_diff() -> None:
    """They are what `--base` adds, so they can be asked for."""
    assert {"VER001", "LNT019"} <= lint_rule_ids()


def test_explain_takes_any_case(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explain", "ver001"]) == 0
    assert capsys.readouterr().out.startswith("# VER001")


def test_levels_in_the_configuration() -> None:
    assert parse_config(b"[severity]\nlnt001 = 'off'\n").severity == {"LNT001": "off"}


@pytest.mark.parametrize("rule", ["VER001", "LNT019", "LNT030"])
def test_rules_of_a_change_need_a_base(rule: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing found without a comparison would be a wrong all-clear."""
    assert run(["lint", ".", "--select", rule]) == 2
    assert capsys.readouterr().err.endswith("hint: add --base REF\n")
