"""Readers that take nothing and let the middleware itself tell what it sees: late writers, silent ones, no match."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import Any, Final

from cyclonedds.core import DDSException, Policy
from cyclonedds.core import Qos as DdsQos
from cyclonedds.domain import DomainParticipant

from ecm_extract.observe.dds.discovery import Found
from ecm_extract.observe.dds.names import meaning
from ecm_extract.observe.dds.qos import model_qos
from ecm_extract.observe.dds.raw import RawReader
from ecm_extract.observe.model import Incident, IncidentKind
from ecm_extract.observe.qos_match import misfits

_MOST: Final = 200
# Source: DDS 1.4, 2.2.3, ids of policies in the order of the headers of every vendor.
_POLICIES: Final = {2: "durability", 4: "deadline_ms", 8: "liveliness", 11: "reliability"}
_ASKED: Final = (Policy.Reliability, Policy.Durability, Policy.Deadline, Policy.Liveliness)


class Watchdogs:
    """One reader for each kind of time that a writer promises, and one like each reader that cannot match."""

    def __init__(self, participant: DomainParticipant) -> None:
        self._participant = participant
        self._readers: dict[tuple[str, str], RawReader] = {}

    def follow(self, endpoints: Iterable[Found]) -> None:
        """Watch what is new."""
        by_topic: defaultdict[str, list[Found]] = defaultdict(list)
        for end in endpoints:
            if meaning(end.topic, end.writes) is not None:
                by_topic[end.topic].append(end)
        for ends in by_topic.values():
            writers = [end for end in ends if end.writes]
            for writer in writers:
                self._watch_time(writer)
                for reader in ends:
                    if not reader.writes:
                        self._ask_alike(writer, reader)

    def incidents(self) -> Iterator[Incident]:
        """Yield what the middleware reported."""
        for (topic, _), raw in self._readers.items():
            yield from _incidents(f"/{topic.partition('/')[2]}", raw.reader)

    def _watch_time(self, writer: Found) -> None:
        """Asks for the deadline and the lease that the writer offers, and for nothing else."""
        offered = model_qos(writer.qos)
        if offered.deadline_ms is not None or offered.lease_ms is not None:
            kinds = (Policy.Deadline, Policy.Liveliness)
            wanted = [writer.qos[kind] for kind in kinds if kind in writer.qos]
            why = f"{offered.deadline_ms} {offered.liveliness} {offered.lease_ms}"
            self._open(writer, why, DdsQos(Policy.Reliability.BestEffort, *wanted))

    def _ask_alike(self, writer: Found, reader: Found) -> None:
        """Keeps the last message only, so that it holds no other writer of the topic back."""
        wanted = model_qos(reader.qos)
        if any(misfits(model_qos(writer.qos), wanted)):
            asked = [reader.qos[kind] for kind in _ASKED if kind in reader.qos]
            self._open(writer, str(wanted), DdsQos(*asked, Policy.History.KeepLast(1)))

    def _open(self, end: Found, why: str, wanted: DdsQos) -> None:
        key = (end.topic, why)
        if key not in self._readers and len(self._readers) < _MOST:
            # What cannot be opened is told by the listener of the topic.
            with suppress(DDSException):
                self._readers[key] = RawReader(self._participant, end.topic, end.type, end.type_id, wanted)


def _incidents(name: str, reader: Any) -> Iterator[Incident]:
    refused = reader.get_requested_incompatible_qos_status()
    policy = _POLICIES.get(refused.last_policy_id)
    if refused.total_count and policy is not None:
        yield Incident("incompatible_qos", name, policy, count=refused.total_count)
    counts: tuple[tuple[IncidentKind, int], ...] = (
        ("deadline_missed", reader.get_requested_deadline_missed_status().total_count),
        ("liveliness_lost", reader.get_liveliness_changed_status().not_alive_count),
    )
    for kind, count in counts:
        if count:
            yield Incident(kind, name, count=count)
