"""Life cycle: a managed node works in the state that its contract names, and in no other, under a real ROS 2."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Sequence

from path_a.predictions import check, manifest, rules
from path_a.ros1 import PROGRAMS
from path_a.ros2 import PYTHON, environment, require, running
from path_a.row import FIXTURES, Case, NotMeasured, Observed

SECONDS = 2.0
_STATES = ("unconfigured", "inactive", "active")
_TALKER = FIXTURES / "lifecycle_talker"
_PATIENCE_S = 200
_PRECONDITION = "BEH008"


def measure(repetitions: int) -> Sequence[Case]:
    found = {state: _told(state) for state in _STATES}
    predictions = {state: _prediction(told) for state, told in found.items()}
    try:
        require(("rclpy", "lifecycle_msgs", "std_msgs"))
    except NotMeasured as reason:
        return [Case(f"a managed node that is {state}", predictions[state], missing=str(reason)) for state in _STATES]
    runs = [_repetition() for _ in range(repetitions)]
    return [_case(state, predictions[state], bool(found[state]), [run[state] for run in runs]) for state in _STATES]


def _told(state: str) -> str:
    """The rule that says that a precondition does not hold in a state; empty when it holds."""
    call = str(FIXTURES / "calls" / f"{state}.yaml")
    found = check("invoke", manifest("lifecycle_talker", "talker"), "--call", call)
    against = tuple(each for each in found if each.rule == _PRECONDITION)
    return rules(against) if against else ""


def _prediction(told: str) -> str:
    return f"nothing is heard of it ({told})" if told else "it is heard (nothing against it)"


def _case(state: str, prediction: str, silent: bool, counts: Sequence[int]) -> Case:
    observed = tuple(Observed(f"{count} messages in {SECONDS:g} s", (count == 0) is silent) for count in counts)
    return Case(f"a managed node that is {state}", prediction, observed)


def _repetition() -> dict[str, int]:
    domain = 10 + os.getpid() % 80
    variables = environment(domain, PYTHONPATH=f"{_TALKER}:{os.environ.get('PYTHONPATH', '')}")
    with running([PYTHON, "-m", "lifecycle_talker.talker"], variables):
        line = [PYTHON, str(PROGRAMS / "lifecycle_listener.py"), "/talker", "/chatter", str(SECONDS)]
        done = subprocess.run(line, env=variables, capture_output=True, text=True, timeout=_PATIENCE_S, check=False)
    if done.returncode:
        raise NotMeasured(done.stderr.strip())
    found: dict[str, int] = json.loads(done.stdout.strip().splitlines()[-1])
    return found
