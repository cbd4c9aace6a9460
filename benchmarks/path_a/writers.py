"""Several writers of one actuator: a simulated diff drive under the real ROS 1 master.

The rule says that the robot follows whichever message came last, and so its commands turn round all the time. How far
it gets is shown and decides nothing: it depends on who happens to come right after whom, and may be what was told.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

from ecm_extract.observe.compare import compare
from ecm_extract.observe.ros1 import watch_ros1
from ecm_extract.observe.watch import Watch
from path_a.predictions import check, rules
from path_a.ros1 import PACKAGES, PROGRAMS, Master, master, require
from path_a.row import FIXTURES, Case, Observed

SPEED = 0.5
SECONDS = 4.0
_SCRIPTS = FIXTURES / "cmd_vel_robot" / "scripts"
_TOLERANCE = 0.15
_OFTEN = 0.5


def measure(repetitions: int) -> Sequence[Case]:
    require(("rospy", "geometry_msgs.msg", "nav_msgs.msg"), PACKAGES)
    return [
        _case("one writer of /cmd_vel", "one_writer", ("teleop",), repetitions),
        _case("two writers of /cmd_vel", "two_writers", ("teleop", "follower"), repetitions),
    ]


def _case(name: str, launch: str, writers: tuple[str, ...], repetitions: int) -> Case:
    found = check(str(FIXTURES / "cmd_vel_robot"), "--launch", f"cmd_vel_robot/launch/{launch}.launch")
    conflict = any(each.rule == "RES002" for each in found)
    expected = "commands turn round all the time" if conflict else f"it goes {SPEED * SECONDS:.1f} m as told"
    observed = tuple(_repetition(writers, conflict) for _ in range(repetitions))
    return Case(name, f"{expected} ({rules(found)})", observed)


def _repetition(writers: tuple[str, ...], conflict: bool) -> Observed:
    with master() as core:
        core.start(_SCRIPTS / "diff_drive.py")
        for name in writers:
            core.start(_SCRIPTS / f"{name}.py")
        _settle(core, len(writers))
        found = core.output(PROGRAMS / "drive_recorder.py", str(SECONDS))
        seen = _seen(core)
    way, commands, turns = float(found["way"]), int(found["commands"]), int(found["turns"])
    goes = abs(way - SPEED * SECONDS) <= _TOLERANCE * SPEED * SECONDS
    torn = turns >= commands * _OFTEN
    text = (
        f"{way:+.2f} m in {SECONDS:g} s where {SPEED * SECONDS:.1f} m were told, "
        f"{turns} of {commands} commands turn round; observe: {seen or 'nothing'}"
    )
    as_told = goes and turns == 0
    return Observed(text, (torn if conflict else as_told) and ("OBS009" in seen) is conflict)


def _settle(core: Master, writers: int) -> None:
    """Until every writer is registered."""
    for _ in range(100):
        (seen,) = watch_ros1(core.uri, 0, once=True)
        if sum(end.role == "publisher" and end.name == "/cmd_vel" for end in seen.endpoints) == writers:
            return
        time.sleep(0.1)


def _seen(core: Master) -> str:
    *_, seen = watch_ros1(core.uri, 1.0)
    return " ".join(sorted({each.rule for each in compare(Watch(seen)) if each.severity == "error"}))
