"""Endpoints of all participants, by the built-in topics of DDS."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from cyclonedds.builtin import (
    BuiltinDataReader,
    BuiltinTopicDcpsParticipant,
    BuiltinTopicDcpsPublication,
    BuiltinTopicDcpsSubscription,
)
from cyclonedds.core import InstanceState
from cyclonedds.domain import DomainParticipant

_AT_ONCE = 200


class Found(NamedTuple):
    """An endpoint as discovery tells it: 16 bytes of key, whether it writes, names, policies, type identifier."""

    key: bytes
    participant: bytes
    writes: bool
    topic: str
    type: str
    qos: Any
    type_id: Any


class Discovery:
    """What is there now; our own participant is left out.

    Attributes:
        endpoints, participants: by key.
        changes: how often an endpoint came or went.
    """

    def __init__(self, participant: DomainParticipant) -> None:
        self._own = participant.guid
        self._participants = BuiltinDataReader(participant, BuiltinTopicDcpsParticipant)
        self._readers = (
            (True, BuiltinDataReader(participant, BuiltinTopicDcpsPublication)),
            (False, BuiltinDataReader(participant, BuiltinTopicDcpsSubscription)),
        )
        self.endpoints: dict[bytes, Found] = {}
        self.participants: dict[bytes, Any] = {}
        self.changes = 0

    def look(self) -> None:
        """Take what was told since the last look."""
        for sample in _taken(self._participants):
            if sample.key != self._own and _is_alive(sample):
                self.participants[sample.key.bytes] = sample.qos
        for writes, reader in self._readers:
            for sample in _taken(reader):
                self._take(sample, writes)

    def _take(self, sample: Any, writes: bool) -> None:
        """A sample that is disposed of has a key and may have no more."""
        self.changes += 1
        if not _is_alive(sample):
            self.endpoints.pop(sample.key.bytes, None)
        elif sample.participant_key != self._own:
            key = sample.key.bytes
            self.endpoints[key] = Found(
                key,
                sample.participant_key.bytes,
                writes,
                sample.topic_name,
                sample.type_name,
                sample.qos,
                sample.type_id,
            )


def _taken(reader: BuiltinDataReader) -> Iterator[Any]:
    while samples := reader.take(N=_AT_ONCE):
        yield from samples


def _is_alive(sample: Any) -> bool:
    info = getattr(sample, "sample_info", None)
    return info is not None and info.instance_state == InstanceState.Alive and hasattr(sample, "qos")
