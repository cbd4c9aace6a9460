"""The middleware saw a deadline missed, a writer fall silent, or messages lost."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.model import IncidentKind
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS014",
    name="timeout_seen",
    dimension="recovery",
    severity="warning",
    who="safety",
    consequence="who reads the topic acted on old data unless it watches the time itself",
    resolution="see that the reader stops safely on it (recovery.safe_stop), then find why the writer was late",
)
_TEXTS: Mapping[IncidentKind, str] = MappingProxyType(
    {
        "deadline_missed": "missed its deadline",
        "liveliness_lost": "lost a writer that did not say that it is alive",
        "message_lost": "lost messages",
    }
)


def check(watch: Watch) -> Iterator[Finding]:
    """Incidents of the kinds above. We listen best effort, so a message may have been lost on its way to us alone."""
    for incident in watch.seen.incidents:
        if incident.kind in _TEXTS:
            text = f"{incident.name} {_TEXTS[incident.kind]} {incident.count} time(s)"
            subjects = (incident.node or incident.name,)
            yield RULE.seen(text, Entity(incident.kind, incident.name), subjects, certainty="likely")
