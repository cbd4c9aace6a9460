"""What Path A predicts comes from contracts of the fixtures, and a row is confirmed only when every repetition is."""

from __future__ import annotations

import pytest
from path_a import claim, lifecycle, permission, qos_ros2, writers
from path_a.predictions import check, contract, diff, manifest, manifests, rules
from path_a.recovery import _timeout
from path_a.row import FIXTURES, Case, Observed, shown


@pytest.mark.parametrize(
    ("observed", "missing", "verdict"),
    [
        ((True, True), "", "confirmed"),
        ((True, False), "", "REFUTED"),
        ((), "no master", "not measured"),
    ],
)
def test_verdict(observed: tuple[bool, ...], missing: str, verdict: str) -> None:
    case = Case("name", "prediction", tuple(Observed("text", each) for each in observed), missing)
    assert case.verdict == verdict
    assert shown(case).startswith(f"name: {verdict}\n  predicted: prediction")


def test_every_policy_is_predicted() -> None:
    """One finding for each pair that cannot match, none for the others."""
    found = check("compose", manifest("qos_pairs", "writer"), manifest("qos_pairs", "reader"))
    told = sorted((each.rule, each.message.split(":")[0]) for each in found)
    assert told == [
        ("BEH001", "/reliability/best_effort_to_reliable"),
        ("BEH002", "/durability/volatile_to_transient_local"),
        ("BEH003", "/deadline/longer_to_shorter"),
        ("BEH003", "/deadline/none_to_some"),
        ("BEH004", "/liveliness/automatic_to_manual"),
        ("BEH005", "/lease/longer_to_shorter"),
    ]


@pytest.mark.parametrize(("launch", "told"), [("one_writer", "nothing against it"), ("two_writers", "RES002")])
def test_writers_are_predicted(launch: str, told: str) -> None:
    found = check(str(FIXTURES / "cmd_vel_robot"), "--launch", f"cmd_vel_robot/launch/{launch}.launch")
    assert rules(found) == told


def test_the_frame_is_predicted() -> None:
    sides = (manifest("frame_handover", name) for name in ("detector", "grasper"))
    assert "SIG006" in rules(check("chain", *sides))


def test_the_renamed_field_is_predicted() -> None:
    old, new, guard = (str(FIXTURES / name) for name in ("limits_1", "limits_2", "limit_guard"))
    assert rules(diff(old, new, "--consumer", guard)) == "VER001"
    assert diff(old, old, "--consumer", guard) == ()


def test_the_lost_watchdog_is_predicted() -> None:
    """The first version names its safe stop, and the second one is told to have lost it."""
    assert _timeout("watched_base_1") == 0.5
    assert contract("watched_base_2", "watched_base").recovery.safe_stop is None
    found = check("upgrade", str(manifests("watched_base_1")), str(manifests("watched_base_2")))
    assert "REC006" in rules(found)


def test_what_is_not_at_hand_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """Everything is predicted, and nothing is called measured without its middleware."""
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    monkeypatch.setattr(permission, "which", lambda _name: None)
    rows = [*claim.measure(1), *permission.measure(1), *lifecycle.measure(1), *qos_ros2.measure(1)]
    assert {case.verdict for case in rows} == {"not measured"}
    told = {case.name: case.prediction for case in rows}
    assert "RES001" in told["second claim of a command interface"]
    assert "PERM005" in told["commander under the policy ward"]
    assert "nothing against it" in told["commander under the policy driver"]
    assert "BEH008" in told["a managed node that is inactive"]
    assert "nothing against it" in told["a managed node that is active"]
    assert "BEH001" in told["QoS in ROS 2 reliability/best_effort_to_reliable"]


def test_a_criterion_that_was_changed_is_told() -> None:
    """A row that was judged by another criterion says how it came out then."""
    case = Case("name", "prediction", (Observed("text", True),), history=("1 of 5 refuted it",))
    assert shown(case).endswith("  history: 1 of 5 refuted it")


@pytest.mark.parametrize(
    ("way", "turns", "seen", "conflict", "confirmed"),
    [
        (2.0, 0, "", False, True),
        (2.0, 0, "OBS009", False, False),
        (1.0, 0, "", False, False),
        (2.0, 159, "OBS009", True, True),
        (0.2, 159, "", True, False),
        (0.2, 10, "OBS009", True, False),
    ],
)
def test_criterion_of_writers(way: float, turns: int, seen: str, conflict: bool, confirmed: bool) -> None:
    """Commands that turn round and what observe says decide; the way does for one writer only."""
    assert writers.Driven(way, 160, turns, seen).confirms(conflict) is confirmed
