"""Listening to every topic."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from typing import Final

from cyclonedds.core import DDSException, Policy
from cyclonedds.core import Qos as DdsQos
from cyclonedds.domain import DomainParticipant
from cyclonedds.util import duration
from ecm_checker.contract import Qos
from ecm_checker.hub.roles import writing_roles

from ecm_extract.observe.dds.discovery import Found
from ecm_extract.observe.dds.names import meaning, ros_type
from ecm_extract.observe.dds.qos import model_qos
from ecm_extract.observe.dds.raw import RawReader
from ecm_extract.observe.hearing.heard import Channel, Heard, Listener
from ecm_extract.observe.hearing.layouts import begins_with_header
from ecm_extract.observe.model import Incident

MOST_READERS: Final = 500
_DEPTH: Final = 100
_NodeOf = Callable[[bytes], str | None]


class Listening:
    """One reader for each topic, best effort, so that it never holds a writer back."""

    def __init__(self, participant: DomainParticipant, heard: Heard, node_of: _NodeOf) -> None:
        self._participant = participant
        self._heard = heard
        self._node_of = node_of
        self._readers: dict[str, RawReader] = {}
        self._kinds: dict[str, str | None] = {}
        self._latched: dict[str, bool] = {}
        self._listeners: dict[tuple[str, int], Listener] = {}
        self.refused: dict[str, str] = {}

    def follow(self, endpoints: Iterable[Found]) -> None:
        """Listen to topics with a writer that is new."""
        for end in endpoints:
            told = meaning(end.topic, end.writes)
            if end.writes and told is not None and told.role in writing_roles() and end.topic not in self._readers:
                self._open(end, told.name)

    def take(self) -> None:
        """Take what came."""
        now = time.time_ns()
        for topic, reader in self._readers.items():
            for message in reader.take():
                self._listener(topic, reader, message.writer).message(message.data, now, sent_ns=message.written_ns)

    def incidents(self) -> Iterator[Incident]:
        """Yield topics of which messages were lost on their way to us."""
        for topic, reader in self._readers.items():
            lost = reader.reader.get_sample_lost_status().total_count
            if lost:
                yield Incident("message_lost", f"/{topic.partition('/')[2]}", count=lost)

    def _open(self, end: Found, name: str) -> None:
        if end.topic in self.refused:
            return
        if len(self._readers) >= MOST_READERS:
            self.refused[end.topic] = f"there are more than {MOST_READERS} topics"
            return
        try:
            qos = _for(model_qos(end.qos))
            self._readers[end.topic] = RawReader(self._participant, end.topic, end.type, end.type_id, qos)
            self._kinds[end.topic] = ros_type(end.type)
            self._latched[end.topic] = model_qos(end.qos).durability == "transient_local"
        except DDSException as error:
            self.refused[end.topic] = f"{name} cannot be listened to: {error}"

    def _listener(self, topic: str, reader: RawReader, writer: int) -> Listener:
        key = (topic, writer)
        if key not in self._listeners:
            kind = self._kinds[topic]
            owner = reader.writer_key(writer)
            channel = Channel(
                f"/{topic.partition('/')[2]}",
                self._node_of(owner) if owner is not None else None,
                kind,
                "cdr",
                kind is not None and begins_with_header(kind, None),
                self._latched[topic],
            )
            self._listeners[key] = self._heard.listener(channel)
        return self._listeners[key]


def _for(offered: Qos) -> DdsQos:
    """Best effort and volatile, unless the writer keeps messages for late readers."""
    keeps = offered.durability == "transient_local" and offered.reliability == "reliable"
    return DdsQos(
        Policy.Reliability.Reliable(duration(milliseconds=100)) if keeps else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if keeps else Policy.Durability.Volatile,
        Policy.History.KeepLast(_DEPTH),
    )
