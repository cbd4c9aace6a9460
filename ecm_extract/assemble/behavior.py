"""Behavior: what a module waits for, how often it acts, what done means, QoS per topic."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import msgspec
from ecm_checker.contract import Behavior, Evidence, Interface, Value
from ecm_checker.hub.roles import roles

from ecm_extract.assemble.evidence import inferred, last_told, number_of, of_interfaces, parameters_where
from ecm_extract.link.endpoints.observe import Observation
from ecm_extract.link.linker import LinkedModule

_RATE_NAMES = frozenset({"update_rate", "publish_rate", "rate", "loop_rate", "controller_frequency", "frequency"}) | {
    "publish_frequency",
    "update_frequency",
    "planner_frequency",
    "rate_hz",
}
_WAITS = {
    "wait_service": "service_available",
    "wait_action": "action_server_available",
    "wait_message": "message_received",
}

_RESULT = "result"
"""How an action ends."""


def behavior_of(entry: LinkedModule) -> Behavior:
    """Return the behavior section of a module."""
    return Behavior(
        preconditions=_preconditions(entry),
        postconditions=_postconditions(entry.interfaces),
        completion_semantics=_completion(entry.interfaces),
        rates=_rates(entry),
        qos=_qos(entry.interfaces),
    )


def _preconditions(entry: LinkedModule) -> Value | None:
    """What the module waits for before it is active, and the lifecycle state in which it works.

    A callback that waits delays itself: the module is active all the same.
    """
    found: dict[str, Evidence] = {}
    for seen in entry.observations:
        if seen.kind in _WAITS and seen.beginning:
            found.setdefault(_awaited(seen, entry.interfaces), seen.evidence)
    for edge in entry.interfaces:
        if edge.row.hears_transforms and edge.frame and "{" not in edge.frame:
            found.setdefault(f"transform {edge.frame} available", edge.evidence[0])
    if entry.lifecycle:
        found.setdefault("lifecycle_state == active", Evidence(entry.module.path, entry.module.line))
    return inferred(list(found), found.values(), "folded")


def _awaited(seen: Observation, interfaces: Iterable[Interface]) -> str:
    """The awaited name; a wait without one is for the module's only client of that kind."""
    word = _WAITS[seen.kind]
    if seen.name:
        return f"{word} {seen.name}"
    names = {entry.name for entry in interfaces if entry.row.calls and roles()[entry.row.peer].awaited == word}
    return f"{word} {names.pop()}" if len(names) == 1 else word


def _postconditions(interfaces: Sequence[Interface]) -> Value | None:
    """An action that succeeds has sent its result."""
    served = [entry for entry in interfaces if entry.row.ends == _RESULT and "{" not in entry.name]
    return of_interfaces([f"{entry.name} result == succeeded" for entry in served], served)


def _completion(interfaces: Sequence[Interface]) -> Value | None:
    """An action is done with its result, a service with its response; publishers stream."""
    return last_told(interfaces, lambda row: row.ends)


def _rates(entry: LinkedModule) -> Value | None:
    """Hertz of timers and loops, and of parameters that are called so."""
    rates: dict[str, float] = {}
    evidence: list[Evidence] = []
    for seen in entry.observations:
        if seen.kind not in {"timer", "rate"} or seen.value is None:
            continue
        hertz = seen.value if seen.kind == "rate" else 1 / seen.value
        label = seen.kind if seen.kind not in rates else f"{seen.kind}_{len(rates) + 1}"
        if round(hertz, 6) not in rates.values():
            rates[label] = round(hertz, 6)
            evidence.append(seen.evidence)
    for parameter in parameters_where(entry.interfaces, _RATE_NAMES.__contains__):
        number = number_of(parameter)
        if number is not None and number > 0:
            rates[parameter.name] = number
            evidence.append(parameter.evidence[0])
    return inferred(rates, evidence, "folded")


def _qos(interfaces: Sequence[Interface]) -> Value | None:
    """Without topics it stays undeclared."""
    found = [entry for entry in interfaces if entry.qos is not None]
    return of_interfaces({f"{entry.role} {entry.name}": msgspec.to_builtins(entry.qos) for entry in found}, found)
