"""A new version needs more of the robot than the one before."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf

from ecm_checker.case import Case
from ecm_checker.demand import Unmet, actuators, compute, sensors, timing, undeclared
from ecm_checker.finding import Entity, Finding
from ecm_checker.profiles import Embodiment
from ecm_checker.rule import Rule
from ecm_checker.units import number
from ecm_checker.view import View

RULE = Rule(
    id="RES010",
    name="resource_demand_grew",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResDeltaSafe",),
    consequence="what was provisioned for the old version does not suffice; the new one does not start or is too slow",
    resolution="check that the robot has it, and provision it before the upgrade",
)

_FIELDS = ("sensors", "actuators", "compute", "exclusive_locks")


def check(case: Case) -> Iterator[Finding]:
    """Demands that the old version did not have, against the robot when it is known."""
    old, robot = case.previous, case.profiles.embodiment
    for new in case.modules if old is not None else ():
        assert old is not None
        missing = {(each.kind, each.name) for each in _demands(new, robot)} if robot is not None else set()
        for each in _demands(new, _as_robot(old)):
            yield _finding(new, each, robot is not None, (each.kind, each.name) in missing)
        for lock in sorted(set(new.locks or ()) - set(old.locks or ())):
            yield _finding(new, Unmet("claim", lock, ""), False, False)
        silent = [f"resources.{name}" for name in _FIELDS if _dropped(old, new, name)]
        for field in silent:
            yield from undeclared(RULE, field, (new,))


def _as_robot(old: View) -> Embodiment:
    """The old version as if it were the robot: what it did not ask for is not there."""
    times = old.timing or {}
    return Embodiment(
        sensors=None if old.sensors is None else tuple(each.text for each in old.sensors),
        actuators=None if old.actuators is None else tuple(each.text for each in old.actuators),
        compute=None if old.compute is None else dict(old.compute),
        control_hz=number(times.get("ctrl_hz")) or 0.0,
        latency_ms=number(times.get("max_latency_ms")) or inf,
    )


def _dropped(old: View, new: View, name: str) -> bool:
    before, now = old.contract.resources, new.contract.resources
    return getattr(before, name) is not None and getattr(now, name) is None


def _finding(new: View, each: Unmet, asked: bool, unmet: bool) -> Finding:
    state = "which the robot does not have" if unmet else "which the robot has" if asked else "new in this version"
    text = f"{new.id} now needs {each.kind} {each.name}, {state}"
    entity = Entity(each.kind, "", each.name)
    evidence = new.evidence(*(f"resources.{name}" for name in _FIELDS))
    if asked:
        return RULE.finding(text, entity, (new,), evidence, severity="error" if unmet else "warning")
    return RULE.finding(text, entity, (new,), evidence, certainty="unknown")


def _demands(module: View, robot: Embodiment) -> Iterator[Unmet]:
    for demands in (sensors, actuators, compute, timing):
        yield from demands(module, robot)
