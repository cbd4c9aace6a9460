"""QoS in a real ROS 2: the two nodes of the fixture themselves, by rclpy, in two processes."""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections.abc import Mapping, Sequence
from tempfile import TemporaryFile

from path_a import qos
from path_a.ros1 import PROGRAMS
from path_a.ros2 import PYTHON, environment, require, running
from path_a.row import FIXTURES, Case, NotMeasured

_WHERE = "QoS in ROS 2"
_PATIENCE_S = 200
# rclpy/event_handler.py, the warning of its own callback for incompatible QoS.
_REFUSED = re.compile(r"topic '(\S+?)'.*incompatible QoS.*Last incompatible policy: (\w+)")


def measure(repetitions: int) -> Sequence[Case]:
    found, topics = qos.predicted(), qos.offered()
    try:
        require(("rclpy", "geometry_msgs"))
    except NotMeasured as reason:
        return [qos.case(topic, found, (), _WHERE, str(reason)) for topic in topics]
    runs = [_run() for _ in range(repetitions)]
    return [qos.case(topic, found, [run.get(topic, (-1, "no such topic")) for run in runs], _WHERE) for topic in topics]


def _run() -> Mapping[str, tuple[int, str]]:
    """One repetition: counts by topic, and the policies that the reader's rclpy calls incompatible."""
    variables = environment(10 + os.getpid() % 80)
    with running(_line("write"), variables), TemporaryFile("w+") as words:
        done = subprocess.run(
            _line("read"),
            env=variables,
            stdout=subprocess.PIPE,
            stderr=words,
            text=True,
            timeout=_PATIENCE_S,
            check=False,
        )
        words.seek(0)
        said = words.read()
    if done.returncode:
        raise NotMeasured(said.strip())
    refused = {f"/{topic.lstrip('/')}": policy.lower() for topic, policy in _REFUSED.findall(said)}
    counts: Mapping[str, int] = json.loads(done.stdout.strip().splitlines()[-1])
    return {topic: (count, refused.get(topic, "")) for topic, count in counts.items()}


def _line(what: str) -> list[str]:
    return [PYTHON, str(PROGRAMS / "ros2_pairs.py"), what, str(FIXTURES / "qos_pairs"), str(qos.SAMPLES)]
