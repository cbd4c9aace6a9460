"""Several writers of one actuator: a simulated diff drive under the real ROS 1 master.

The rule says that the robot follows whichever message came last, and so its commands turn round all the time. How far
it gets is shown and decides nothing: it depends on who happens to come right after whom, and may be what was told.
That was learnt from a prediction that failed, which `_HISTORY` tells and the row prints.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

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
_HISTORY = (
    (
        "the first criterion was that the base does not get within 15 % of the way that was told; 1 of 5 did "
        "get there, so the prediction was refuted by it"
    ),
    (
        "the second criterion was made after that result: at least half of the commands turn round, and observe says "
        "OBS009; the base of the fixture then also began to add up its way by time and no longer by loops"
    ),
    "it stands unchanged since, in commit c1949d3, and every run after that is a fresh one",
)


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
    driven = [_repetition(writers) for _ in range(repetitions)]
    observed = tuple(Observed(each.text, each.confirms(conflict)) for each in driven)
    off = sum(not each.goes for each in driven)
    first = f"by the first criterion {off} of these {len(driven)} repetitions would confirm it"
    return Case(name, f"{expected} ({rules(found)})", observed, history=(*_HISTORY, first) if conflict else ())


@dataclass(frozen=True)
class Driven:
    """One repetition: metres, commands, how many of them turn round, and errors that observe reports."""

    way: float
    commands: int
    turns: int
    seen: str

    @property
    def goes(self) -> bool:
        """Whether it gets where it is told."""
        return abs(self.way - SPEED * SECONDS) <= _TOLERANCE * SPEED * SECONDS

    def confirms(self, conflict: bool) -> bool:
        """The second criterion."""
        torn = self.commands > 0 and self.turns >= self.commands * _OFTEN
        as_told = self.goes and self.turns == 0
        return (torn if conflict else as_told) and ("OBS009" in self.seen) is conflict

    @property
    def text(self) -> str:
        return (
            f"{self.way:+.2f} m in {SECONDS:g} s where {SPEED * SECONDS:.1f} m were told, "
            f"{self.turns} of {self.commands} commands turn round; observe: {self.seen or 'nothing'}"
        )


def _repetition(writers: tuple[str, ...]) -> Driven:
    with master() as core:
        core.start(_SCRIPTS / "diff_drive.py")
        for name in writers:
            core.start(_SCRIPTS / f"{name}.py")
        _settle(core, len(writers))
        found = core.output(PROGRAMS / "drive_recorder.py", str(SECONDS))
        return Driven(float(found["way"]), int(found["commands"]), int(found["turns"]), _seen(core))


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
