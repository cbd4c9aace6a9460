"""Claims: ros2_control's own controller manager and the second claim on one command interface."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from path_a.predictions import check, rules
from path_a.ros2 import environment, require, running
from path_a.row import FIXTURES, Case, NotMeasured, Observed

_ARM = FIXTURES / "arm_claims"
_CONTROLLERS = str(_ARM / "config" / "controllers.yaml")
_PACKAGES = ("controller_manager", "forward_command_controller", "robot_state_publisher")
_PATIENCE_S = 200
_MANAGER_S = "90"


def measure(repetitions: int) -> Sequence[Case]:
    found = check(str(_ARM), "--launch", "arm_claims/launch/arm.launch.py")
    prediction = f"the second claim on joint1/position is refused ({rules(found)})"
    name = "second claim of a command interface"
    try:
        require(_PACKAGES)
    except NotMeasured as reason:
        return [Case(name, prediction, missing=str(reason))]
    return [Case(name, prediction, tuple(_repetition() for _ in range(repetitions)))]


def _repetition() -> Observed:
    """Both controllers by the manager's own spawner, one after the other; the log of the manager says why."""
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "manager.log"
        with _manager(log):
            first = _spawned("trajectory_controller")
            second = _spawned("jog_controller")
        said = [line for line in log.read_text("utf-8", "replace").splitlines() if "already claimed" in line]
    words = said[0].partition("]: ")[2] if said else "the manager says nothing of a claim"
    text = f"first {_state(first)}, second {_state(second)}; {words}"
    return Observed(text, first and not second and bool(said))


def _state(active: bool) -> str:
    return "active" if active else "refused"


def _spawned(controller: str) -> bool:
    line = ["ros2", "run", "controller_manager", "spawner", controller, "--controller-manager-timeout", _MANAGER_S]
    try:
        done = subprocess.run(
            [*line, "--param-file", _CONTROLLERS],
            env=_environment(),
            capture_output=True,
            check=False,
            timeout=_PATIENCE_S,
        )
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


@contextmanager
def _manager(log: Path) -> Iterator[None]:
    """The manager, and who tells it of the robot; spawners wait for it themselves."""
    description = (_ARM / "urdf" / "arm.urdf").read_text("utf-8")
    publisher = ["ros2", "run", "robot_state_publisher", "robot_state_publisher", "--ros-args"]
    manager = ["ros2", "run", "controller_manager", "ros2_control_node", "--ros-args", "--params-file", _CONTROLLERS]
    with (
        log.open("w") as output,
        running([*publisher, "-p", f"robot_description:={description}"], _environment()),
        running(manager, _environment(), output),
    ):
        yield


def _environment() -> dict[str, str]:
    return environment(10 + os.getpid() % 80)
