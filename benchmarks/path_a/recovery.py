"""Recovery: the only commander of a base dies; a watchdog that the contract names stops it, a missing one does not."""

from __future__ import annotations

from collections.abc import Sequence

from path_a.predictions import check, contract, manifests, rules
from path_a.ros1 import PACKAGES, PROGRAMS, master, require
from path_a.row import FIXTURES, Case, Observed

SPEED = 0.5
SECONDS = 3.0
_COMMANDER = FIXTURES / "cmd_vel_robot" / "scripts" / "teleop.py"
_MARGIN_S = 0.5


def measure(repetitions: int) -> Sequence[Case]:
    require(("rospy", "geometry_msgs.msg", "nav_msgs.msg"), PACKAGES)
    found = check("upgrade", str(manifests("watched_base_1")), str(manifests("watched_base_2")))
    lost = tuple(each for each in found if each.rule == "REC006" and "safe_stop" in each.message)
    return [
        _case("watchdog that the contract names", "watched_base_1", "", repetitions),
        _case("watchdog that the next version lacks", "watched_base_2", rules(lost) if lost else "", repetitions),
    ]


def _case(name: str, package: str, lost: str, repetitions: int) -> Case:
    timeout = None if lost else _timeout(package)
    expected = "it drives on" if timeout is None else f"it stops within {timeout:g} s"
    source = lost or "recovery.safe_stop"
    return Case(name, f"{expected} ({source})", tuple(_repetition(package, timeout) for _ in range(repetitions)))


def _timeout(package: str) -> float | None:
    """The default of the parameter that the safe stop of the contract names, in seconds."""
    module = contract(package, "watched_base")
    stop = module.recovery.safe_stop
    if stop is None:
        return None
    ends = [each for each in module.signature.interfaces if each.role == "parameter"]
    return next((float(each.default) for each in ends if str(stop.value).find(each.name) >= 0), None)


def _repetition(package: str, timeout: float | None) -> Observed:
    with master() as core:
        core.start(FIXTURES / package / "scripts" / "watched_base.py")
        commander = core.start(_COMMANDER)
        found = core.output(PROGRAMS / "way_after_loss.py", str(commander.pid), str(SECONDS))
    way, speed = float(found["way"]), float(found["speed"])
    stopped = speed == 0 and timeout is not None and way <= SPEED * (timeout + _MARGIN_S)
    drives_on = speed == SPEED and way >= SPEED * (SECONDS - _MARGIN_S)
    text = f"{way:.2f} m further in {SECONDS:g} s after the loss, speed then {speed:g} m/s"
    return Observed(text, drives_on if timeout is None else stopped)
