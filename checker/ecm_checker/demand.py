"""What modules ask of a robot, and what of it the robot does not have."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, Final

import msgspec

from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.fields import required_fields
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.profiles import Embodiment
from ecm_checker.rule import Rule
from ecm_checker.terms import Spec, spec
from ecm_checker.units import number
from ecm_checker.view import View

_REQUIRED: Final = frozenset(required_fields())


class Unmet(msgspec.Struct, frozen=True):
    """A demand that the robot does not meet; `unknown` when the profile does not say.

    Attributes:
        kind: sensor, actuator, compute or timing.
        name: what is asked for.
        text: what is missing.
        certainty: of it.
    """

    kind: str
    name: str
    text: str
    certainty: Certainty = "proved"


UnmetBy = Callable[[View, Embodiment], Iterator[Unmet]]


def unmet_findings(case: Case, rule: Rule, field: str, unmet: UnmetBy) -> Iterator[Finding]:
    """Findings of a rule for what modules ask of the robot; one more for all modules that do not say."""
    robot = case.profiles.embodiment
    if robot is None:
        return
    section_field = f"resources.{field}"
    silent = []
    if section_field in _REQUIRED:
        silent = [module for module in case.modules if module.runs and getattr(module, field) is None]
    for module in case.modules:
        evidence: tuple[Evidence, ...] | None = None
        for each in unmet(module, robot):
            evidence = module.evidence(section_field) if evidence is None else evidence
            text = f"{module.id} needs {each.name}: {each.text}"
            yield rule.finding(text, Entity(each.kind, each.name), (module,), evidence, certainty=each.certainty)
    yield from undeclared(rule, section_field, silent)


def undeclared(rule: Rule, field: str, silent: Iterable[View]) -> Iterator[Finding]:
    """One finding for all modules that do not declare a field that a decision needs."""
    modules = tuple(silent)
    if modules:
        names = ", ".join(module.id for module in modules[:3]) + (" ..." if len(modules) > 3 else "")
        text = (
            f"{field} is undeclared by {len(modules)} module(s) ({names}), so this cannot be decided; if it is not met"
        )
        yield rule.finding(text, Entity("undeclared", field), modules, certainty="unknown", severity="warning")


def sensors(module: View, robot: Embodiment) -> Iterator[Unmet]:
    """Sensors that the robot does not have."""
    return _devices("sensor", module.sensors, robot.sensors)


def actuators(module: View, robot: Embodiment) -> Iterator[Unmet]:
    """Actuators that the robot does not have."""
    return _devices("actuator", module.actuators, robot.actuators)


def compute(module: View, robot: Embodiment) -> Iterator[Unmet]:
    """Computing power that the robot does not have."""
    wanted = {key: item for key, item in (module.compute or {}).items() if item not in (False, 0, None, "")}
    if robot.compute is None:
        yield from (Unmet("compute", key, "the profile does not say", "unknown") for key in wanted)
        return
    for key, item in wanted.items():
        text = _lacks(key, item, robot.compute)
        if text is not None:
            yield Unmet("compute", key if item is True else f"{key} {item}", text)


def timing(module: View, robot: Embodiment) -> Iterator[Unmet]:
    """Rates and latencies that the robot does not reach."""
    wanted = module.timing or {}
    rate, latency = number(wanted.get("ctrl_hz")), number(wanted.get("max_latency_ms"))
    if rate is not None:
        yield from _bound("ctrl_hz", rate, robot.control_hz, robot.control_hz is not None and robot.control_hz < rate)
    if latency is not None:
        late = robot.latency_ms is not None and robot.latency_ms > latency
        yield from _bound("max_latency_ms", latency, robot.latency_ms, late)


def _bound(name: str, wanted: float, has: float | None, broken: bool) -> Iterator[Unmet]:
    if has is None:
        yield Unmet("timing", name, "the profile does not say", "unknown")
    elif broken:
        yield Unmet("timing", name, f"{wanted:g} is asked for, the robot reaches {has:g}")


def _devices(kind: str, wanted: Iterable[Spec] | None, has: Iterable[str] | None) -> Iterator[Unmet]:
    devices = [spec(text) for text in has or ()]
    for each in wanted or ():
        if has is None:
            yield Unmet(kind, each.text, "the profile does not say", "unknown")
        elif not any(_serves(device, each) for device in devices):
            yield Unmet(kind, each.text, f"the robot has {', '.join(has) or 'none'}")


def _serves(device: Spec, wanted: Spec) -> bool:
    mounts = wanted.mount.split("_or_") if wanted.mount else []
    return (
        device.kind.lower() == wanted.kind.lower()
        and (not mounts or not device.mount or device.mount in mounts)
        and (not wanted.rate_hz or not device.rate_hz or device.rate_hz >= wanted.rate_hz)
    )


def _lacks(key: str, wanted: Any, has: Mapping[str, Any]) -> str | None:
    amount = number(wanted)
    available = has.get("gpu_memory", has.get("gpu")) if key == "gpu" and amount is not None else has.get(key)
    if not available:
        return "the robot has none"
    offered = number(available)
    if amount is not None and offered is not None and offered < amount:
        return f"{wanted} is asked for, the robot has {available}"
    return None
