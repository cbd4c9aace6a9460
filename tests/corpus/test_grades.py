"""Which evidence earns which grade."""

from __future__ import annotations

import msgspec
import pytest
from ecm_checker.finding import Finding
from ecm_corpus.grade import graded, is_about
from ecm_corpus.methods import baselines, checker_only, full, without_dimension, without_engine
from ecm_corpus.narrative import Conflict, Limit
from ecm_corpus.results import Versions
from scored_cases import case, finding, narrative, state

HIT = state(finding())
QUIET = state()


@pytest.mark.parametrize(
    ("limit", "buggy", "control", "grade"),
    [
        ("none", HIT, QUIET, "discriminating"),
        ("none", HIT, HIT, "trigger"),
        ("none", QUIET, QUIET, "missed"),
        ("none", QUIET, HIT, "missed"),
        ("class", HIT, QUIET, "class"),
        ("class", HIT, HIT, "trigger"),
        ("out_of_reach", QUIET, QUIET, "out_of_reach"),
        ("out_of_reach", HIT, QUIET, "class"),
        ("not_scorable", HIT, QUIET, "not_scorable"),
    ],
)
def test_grades(limit: Limit, buggy: object, control: object, grade: str) -> None:
    """Only what is flagged when broken and quiet when repaired discriminates; the record limits what that is worth."""
    row = graded(case("R-1", a=buggy, b=control), narrative("R-1", limit), full())  # type: ignore[arg-type]
    assert row.grade == grade
    assert row.strict is (grade == "discriminating")


def test_without_a_repaired_state_nothing_discriminates() -> None:
    assert graded(case("R-1", a=HIT), narrative("R-1", controls=()), full()).grade == "trigger"


def test_without_a_judged_state_nothing_is_scored() -> None:
    assert graded(case("R-1"), narrative("R-1"), full()).grade == "not_scorable"


def test_one_broken_state_is_enough_and_every_repaired_one_must_be_quiet() -> None:
    result = case("R-1", a=QUIET, b=HIT, c=QUIET, d=HIT)
    assert graded(result, narrative("R-1", buggy=("a", "b"), controls=("c",)), full()).grade == "discriminating"
    row = graded(result, narrative("R-1", buggy=("b",), controls=("c", "d")), full())
    assert (row.grade, row.alarms) == ("trigger", ("d",))


@pytest.mark.parametrize(
    ("found", "about"),
    [
        (finding(), True),
        (finding(path="reader.py"), False),
        (finding(path="pkg/otherscripts/reader.py"), False),
        (finding(path="scripts/reader.py"), True),
        (finding(about="/gps/fix2"), False),
        (finding(about="reader /gps/fix"), True),
        (finding(about="/mavros/gps/fix"), False),
        (msgspec.structs.replace(finding(about="/odom"), message="/gps/fix is gone"), False),
    ],
)
def test_a_finding_counts_when_it_is_about_the_conflict(found: Finding, about: bool) -> None:
    """It lies on the file, at a folder's boundary, and is about the name, whatever its message says."""
    assert is_about(found, Conflict(files=("scripts/reader.py",), names=("/gps/fix",))) is about


def test_what_a_rule_always_speaks_of_counts() -> None:
    """A publisher without `queue_size` is named; that its rule looks at this argument stands in the table."""
    named = Conflict(names=("queue_size",))
    assert is_about(finding(rule="LNT034"), named)
    assert not is_about(finding(rule="LNT001"), named)


def test_a_line_counts_like_a_name() -> None:
    """Of several joints with one cause the finding is about the first, and has the lines of all."""
    assert is_about(finding(about="/odom"), Conflict(names=("/gps/fix",), lines=("scripts/reader.py:7",)))
    assert not is_about(finding(about="/odom"), Conflict(names=("/gps/fix",), lines=("scripts/reader.py:8",)))


def test_information_is_no_win_and_no_alarm() -> None:
    hint = state(finding(severity="info"))
    row = graded(case("R-1", a=hint, b=hint), narrative("R-1"), full())
    assert (row.grade, row.hints, row.alarms) == ("missed", 1, ())


def test_methods_see_their_own_findings_only() -> None:
    """A baseline has what its rules say; an ablation loses what rests on the dimension or the engine."""
    result = case("R-1", a=state(finding("BEH001", "behavior"), engine="check"), b=QUIET)
    told = narrative("R-1", gold=("behavior",))
    schema, qos, semver = baselines()
    hit = {name: graded(result, told, method).strict for name, method in (("s", schema), ("q", qos), ("v", semver))}
    assert hit == {"s": False, "q": True, "v": False}
    assert graded(result, told, checker_only()).strict
    assert not graded(result, told, without_engine("check")).strict
    assert not graded(result, told, without_dimension("behavior")).strict
    assert graded(result, told, without_dimension("recovery")).strict


@pytest.mark.parametrize(("new", "flagged"), [("2.0.0", True), ("1.3.0", False), (None, False)])
def test_a_major_step_is_what_semver_sees(new: str | None, flagged: bool) -> None:
    result = case("R-1", a=state(versions=(Versions("pkg", "1.2.0", new),)), b=QUIET)
    assert graded(result, narrative("R-1"), baselines()[2]).flagged is flagged


def test_the_dimension_of_a_win_is_told_apart_from_that_of_the_record() -> None:
    row = graded(case("R-1", a=HIT, b=QUIET), narrative("R-1", gold=("behavior",)), full())
    assert (row.strict, row.attributed) == (True, False)
