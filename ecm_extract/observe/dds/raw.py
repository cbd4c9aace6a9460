"""Readers that give the bytes of messages of any type, without its definition."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, Final, NamedTuple

from cyclonedds.core import DDSException
from cyclonedds.core import Qos as DdsQos
from cyclonedds.domain import DomainParticipant
from cyclonedds.dynamic import get_types_for_typeid
from cyclonedds.idl import make_idl_struct
from cyclonedds.idl.types import uint8
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

_PATIENCE: Final = duration(milliseconds=500)
_AT_ONCE: Final = 200


class RawMessage:
    """The bytes of a message; the reader adds `sample_info`."""

    sample_info: Any

    def __init__(self, data: bytes) -> None:
        self.data = data

    @classmethod
    def deserialize(cls, data: bytes) -> RawMessage:
        """Keep the bytes."""
        return cls(data)

    deserialize_key = deserialize


class Taken(NamedTuple):
    """A message: its bytes, the handle of its writer, nanoseconds at which it was written (0 when not told)."""

    data: bytes
    writer: int
    written_ns: int


class RawReader:
    """Reads one topic. A peer that tells no type information is matched by names; of another its type is asked."""

    def __init__(self, participant: DomainParticipant, topic: str, kind: str, type_id: Any, qos: DdsQos) -> None:
        self._topic = Topic(participant, topic, _type(participant, kind, type_id))
        self._topic.data_type = RawMessage
        self.reader: Any = DataReader(participant, self._topic, qos=qos)
        self._keys: dict[int, bytes | None] = {}

    def take(self) -> list[Taken]:
        """Return messages that came since the last time."""
        found = []
        with suppress(DDSException):
            for sample in self.reader.take(N=_AT_ONCE):
                if isinstance(sample, RawMessage):
                    info = sample.sample_info
                    found.append(Taken(bytes(sample.data), info.publication_handle, info.source_timestamp))
        return found

    def writer_key(self, handle: int) -> bytes | None:
        """The key of a writer; None when it has left."""
        if handle not in self._keys:
            data = self.reader.get_matched_publication_data(handle)
            self._keys[handle] = data.key.bytes if data is not None else None
        return self._keys[handle]


def _type(participant: DomainParticipant, kind: str, type_id: Any) -> Any:
    if type_id is not None:
        with suppress(Exception):  # the type is somebody else's, and its reader raises whatever it leads it to
            return get_types_for_typeid(participant, type_id, _PATIENCE)[0]
    return make_idl_struct("Opaque", kind, {"first": uint8})
