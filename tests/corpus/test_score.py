"""The tables, their statistics, and the commands that print them."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
from click.testing import CliRunner
from ecm_corpus.agree import Judge, Verdict, agreement, kappa
from ecm_corpus.commands.agree import command as agree_command
from ecm_corpus.commands.score import command as score_command
from ecm_corpus.formats import json as as_json
from ecm_corpus.formats import markdown, svg, text
from ecm_corpus.paper import PaperTables
from ecm_corpus.score import score
from ecm_corpus.statistics import mcnemar, share
from scored_cases import small_corpus

PAPER = PaperTables({"robust": {"checker alone": 3}, "ros2": {"checker alone": 1}}, {"robust": {"versioning": 2}})


@pytest.mark.parametrize(
    ("hits", "total", "low", "high"),
    [(10, 32, 18, 49), (10, 16, 39, 82), (2, 32, 2, 20), (0, 16, 0, 19), (3, 16, 7, 43)],
)
def test_intervals_are_those_of_the_paper(hits: int, total: int, low: int, high: int) -> None:
    """Wilson 95 % intervals, paper table of recall."""
    found = share(hits, total)
    assert (round(found.low * 100), round(found.high * 100)) == (low, high)


@pytest.mark.parametrize(("only", "p"), [(8, 0.0078), (7, 0.016)])
def test_mcnemar_is_that_of_the_paper(only: int, p: float) -> None:
    """Exact test with c = 0, paper table of recall."""
    found = mcnemar([True] * only + [False] * 5, [False] * (only + 5))
    assert (found.first_only, found.second_only) == (only, 0)
    assert found.p == pytest.approx(p, rel=0.04)


def test_the_share_of_nothing_is_unknown() -> None:
    assert (share(0, 0).low, share(0, 0).high) == (0.0, 1.0)
    assert mcnemar([], []).p == 1.0


@pytest.mark.parametrize(("name", "render"), [("txt", text.render), ("md", markdown.render), ("json", as_json.render)])
def test_tables(name: str, render: Any, golden: Any) -> None:
    """Everything that a reader of the evaluation gets to see, in each format of words."""
    found, told = small_corpus()
    golden(f"corpus/score.{name}", render(score(found, told, PAPER, ("R-win: changed",))))


def test_the_plot_repeats_byte_for_byte() -> None:
    found, told = small_corpus()
    one, two = (svg.render(score(found, told, PAPER)) for _ in range(2))
    assert one == two
    assert "robust (N = 6)" in one


def test_score_without_results_says_what_writes_them(tmp_path: Path) -> None:
    (tmp_path / "cases" / "interface").mkdir(parents=True)
    done = CliRunner().invoke(score_command, ["--corpus", str(tmp_path)])
    assert "blind --all" in str(done.exception)


def test_the_command_scores_and_tells_a_broken_chain(tmp_path: Path) -> None:
    """Results that were not made by a blind run over these cases are shown, and fail."""
    found, _ = small_corpus()
    (tmp_path / "cases" / "interface").mkdir(parents=True)
    (tmp_path / "cases" / "narrative").mkdir()
    (tmp_path / "cases" / "paper.yaml").write_text("recall: {}\n")
    (tmp_path / "results.json").write_bytes(msgspec.json.encode(found))
    done = CliRunner().invoke(score_command, ["--corpus", str(tmp_path), "--format", "json"])
    assert done.exit_code == 1
    assert len(json.loads(done.output)["broken"]) >= len(found.cases)


@pytest.mark.parametrize(
    ("table", "expected"),
    [
        ([("yes", "yes")] * 20 + [("yes", "no")] * 5 + [("no", "yes")] * 10 + [("no", "no")] * 15, 0.4),
        ([("a", "a")] * 45 + [("a", "b")] * 15 + [("b", "a")] * 25 + [("b", "b")] * 15, 0.1304),
        ([("a", "a")] * 4 + [("b", "b")] * 6, 1.0),
        ([("a", "a")] * 4, None),
        ([], None),
    ],
)
def test_kappa_of_textbook_tables(table: list[tuple[str, str]], expected: float | None) -> None:
    """The worked examples of Cohen's kappa; chance alone leaves nothing to measure."""
    assert kappa(table) == (None if expected is None else pytest.approx(expected, abs=1e-4))


def test_judges_are_compared_over_the_briefs_that_both_have() -> None:
    one = Judge(
        "one", {"x": Verdict("incompatible", "signature"), "y": Verdict("compatible"), "z": Verdict("compatible")}
    )
    two = Judge("two", {"x": Verdict("incompatible", "behavior"), "y": Verdict("compatible")})
    found = agreement(one, two)
    assert (found.briefs, found.outcomes, found.labels) == (2, 2, 1)
    assert found.kappa_outcomes == 1.0


def test_agree_reads_yaml_and_needs_two_judges(tmp_path: Path) -> None:
    for name, outcome in (("one", "compatible"), ("two", "incompatible")):
        lines = f"judge: {name}\nverdicts:\n  x1: {{outcome: {outcome}}}\n  x2: {{outcome: compatible}}\n"
        (tmp_path / f"{name}.yaml").write_text(lines)
    done = CliRunner().invoke(agree_command, [str(tmp_path / "one.yaml"), str(tmp_path / "two.yaml")])
    assert done.output == "one and two, 2 briefs: outcome 1/2, kappa 0.00; with dimension 1/2, kappa 0.00\n"
    assert "two judges" in str(CliRunner().invoke(agree_command, [str(tmp_path / "one.yaml")]).exception)


def test_without_the_libraries_of_the_evaluation_the_way_to_get_them_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They are an extra: who only extracts does not need them."""
    found, _ = small_corpus()
    (tmp_path / "cases" / "interface").mkdir(parents=True)
    (tmp_path / "cases" / "narrative").mkdir()
    (tmp_path / "cases" / "paper.yaml").write_text("recall: {}\n")
    told = tmp_path / "cases" / "narrative" / "R-win.yaml"
    told.write_text(
        "{case: R-win, title: t, story: s, gold: [versioning], source: s, derivable: 'yes', buggy: [a], controls: [b]}"
    )
    (tmp_path / "results.json").write_bytes(msgspec.json.encode(found))
    monkeypatch.setitem(sys.modules, "scipy.stats", None)
    done = CliRunner().invoke(score_command, ["--corpus", str(tmp_path)])
    assert "ecm-extract[evaluation]" in str(done.exception)
