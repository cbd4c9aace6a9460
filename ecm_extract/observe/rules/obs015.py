"""A part of the robot reports through diagnostics that it is not well."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.observe.model import Level
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS015",
    name="diagnostic_level",
    dimension="recovery",
    severity="error",
    who="safety",
    consequence="the part does not do what its contract says, by its own word",
    resolution="do what the message asks for; a level that is normal here belongs into the contract",
)
_SEVERITIES: Mapping[Level, Severity] = MappingProxyType({"error": "error", "stale": "error", "warn": "warning"})


def check(watch: Watch) -> Iterator[Finding]:
    """Every task whose worst level was not OK."""
    for status in watch.seen.statuses:
        severity = _SEVERITIES.get(status.level)
        if severity is not None:
            hardware = f" ({status.hardware})" if status.hardware else ""
            text = f"{status.name}{hardware} reports {status.level.upper()}: {status.message or 'no message'}"
            yield RULE.seen(text, Entity("diagnostic", status.name), (status.name,), severity=severity)
