"""Modules together need more computing power than the robot has."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule
from ecm_checker.units import number
from ecm_checker.view import View

RULE = Rule(
    id="RES007",
    name="joint_compute_exceeded",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResJointSat", "GlobalSafe"),
    consequence="modules starve each other and miss their deadlines",
    resolution="spread them over more computers, or run fewer of them at a time",
)

_ADDED_UP = ("cpu_cores", "memory", "gpu_memory")


def check(case: Case) -> Iterator[Finding]:
    """Sums of what modules need, where each alone would fit."""
    robot = case.profiles.embodiment
    if robot is None or robot.compute is None or len(case.modules) < 2:
        return
    sums: defaultdict[str, float] = defaultdict(float)
    users: defaultdict[str, list[View]] = defaultdict(list)
    for module in case.modules:
        for key in _ADDED_UP:
            amount = number((module.compute or {}).get(key))
            if amount:
                sums[key] += amount
                users[key].append(module)
    for key, total in sums.items():
        limit = number(robot.compute.get(key))
        if limit is not None and total > limit and len(users[key]) > 1:
            evidence = [line for each in users[key] for line in each.evidence("resources.compute")]
            text = f"together they need {total:g} {key}, the robot has {limit:g}"
            yield RULE.finding(text, Entity("compute", key), users[key], evidence)
