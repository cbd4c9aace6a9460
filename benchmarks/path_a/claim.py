"""Claims: ros2_control's own controller manager and the second claim on one command interface."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from path_a.predictions import check, rules
from path_a.row import FIXTURES, Case, NotMeasured, Observed

_ARM = FIXTURES / "arm_claims"
_CONTROLLERS = str(_ARM / "config" / "controllers.yaml")
_PACKAGES = ("controller_manager", "forward_command_controller", "robot_state_publisher")
_PATIENCE_S = 60
_DOMAIN = "77"


def measure(repetitions: int) -> Sequence[Case]:
    found = check(str(_ARM), "--launch", "arm_claims/launch/arm.launch.py")
    prediction = f"the second claim on joint1/position is refused ({rules(found)})"
    name = "second claim of a command interface"
    try:
        _require()
    except NotMeasured as reason:
        return [Case(name, prediction, missing=str(reason))]
    return [Case(name, prediction, tuple(_repetition() for _ in range(repetitions)))]


def _require() -> None:
    """A sourced ROS 2 with everything that the arm needs."""
    if not os.environ.get("AMENT_PREFIX_PATH") or shutil.which("ros2") is None:
        message = "needs a sourced ROS 2 with ros2_control (AMENT_PREFIX_PATH is not set)"
        raise NotMeasured(message)
    for package in _PACKAGES:
        if subprocess.run(["ros2", "pkg", "prefix", package], capture_output=True, check=False).returncode:
            message = f"the sourced ROS 2 ({os.environ.get('ROS_DISTRO', 'unnamed')}) has no {package}"
            raise NotMeasured(message)


def _repetition() -> Observed:
    """Both controllers by the manager's own spawner, one after the other; the log of the manager says why."""
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "manager.log"
        with _manager(log):
            first = _spawned("trajectory_controller")
            second = _spawned("jog_controller")
        said = [line.strip() for line in log.read_text("utf-8", "replace").splitlines() if "already claimed" in line]
    if not first:
        message = "the first controller does not become active: " + log.name
        return Observed(message, False)
    words = said[0] if said else "the manager says nothing of a claim"
    return Observed(
        f"first {'active' if first else 'refused'}, second {'active' if second else 'refused'}; {words}",
        not second and bool(said),
    )


def _spawned(controller: str) -> bool:
    line = ["ros2", "run", "controller_manager", "spawner", controller, "--controller-manager-timeout", "20"]
    return _finished([*line, "--param-file", _CONTROLLERS]) == 0


def _finished(line: list[str]) -> int | None:
    try:
        return subprocess.run(
            line, env=_environment(), capture_output=True, check=False, timeout=_PATIENCE_S
        ).returncode
    except subprocess.TimeoutExpired:
        return None


@contextmanager
def _manager(log: Path) -> Iterator[None]:
    description = (_ARM / "urdf" / "arm.urdf").read_text("utf-8")
    lines = (
        [
            "ros2",
            "run",
            "robot_state_publisher",
            "robot_state_publisher",
            "--ros-args",
            "-p",
            f"robot_description:={description}",
        ],
        ["ros2", "run", "controller_manager", "ros2_control_node", "--ros-args", "--params-file", _CONTROLLERS],
    )
    with log.open("w") as output:
        running = [
            subprocess.Popen(line, env=_environment(), stdout=output, stderr=output, start_new_session=True)
            for line in lines
        ]
        try:
            time.sleep(3.0)
            yield
        finally:
            for process in running:
                os.killpg(process.pid, signal.SIGINT)
            for process in running:
                process.wait(10)


def _environment() -> dict[str, str]:
    return {**os.environ, "ROS_DOMAIN_ID": _DOMAIN, "ROS_LOCALHOST_ONLY": "1"}
