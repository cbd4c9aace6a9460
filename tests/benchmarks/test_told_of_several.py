"""What the benchmarks take for told: names without holes, and changes that one line tells of several programs."""

from __future__ import annotations

from pathlib import Path

import diff_precision
import pytest
from comparisons import Change
from diff_precision import Judgement, Sample, again
from extracted import Interface
from sites import is_named


@pytest.mark.parametrize(
    ("name", "confidence", "named"),
    [("/scan", "literal", True), ("/scan", "pattern", False), ("~/{name}/plan", "literal", False)],
)
def test_a_name_with_a_hole_is_not_told_whole(name: str, confidence: str, named: bool) -> None:
    assert is_named(Interface("publisher", name, name, None, confidence)) is named


@pytest.mark.parametrize(("owner", "told"), [("a_node", 1), ("b_node", 1), ("c", 1), ("d", 0)])
def test_a_change_of_several_programs_is_told_of_each(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], owner: str, told: int
) -> None:
    change = Change(
        "parameter", "removed", "arm", "a_node", "rate", None, True, "no longer declared (also of b_node, c)"
    )
    monkeypatch.setattr(diff_precision, "changes_between", lambda *_: (change,))
    judged = Judgement("arm", ("1", "2"), "parameter", "removed", "arm", owner, "rate", None, "true", "")
    again(Sample(1, "", (judged,)), Path(), None)
    assert f"{told} of 1 true ones told" in capsys.readouterr().out
