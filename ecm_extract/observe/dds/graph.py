"""Nodes, and the endpoints of discovery as endpoints of ROS."""

from __future__ import annotations

from collections.abc import Iterator

from cyclonedds.core import Policy
from cyclonedds.core import Qos as DdsQos
from cyclonedds.domain import DomainParticipant
from cyclonedds.util import duration

from ecm_extract.observe.dds.discovery import Discovery, Found
from ecm_extract.observe.dds.names import NODE_NAMES, meaning, ros_type
from ecm_extract.observe.dds.node_names import nodes_of
from ecm_extract.observe.dds.qos import UNSEEN, model_qos, user_data
from ecm_extract.observe.dds.raw import RawReader
from ecm_extract.observe.model import Endpoint, Gap, Node


class Graph:
    """Discovery with the names of nodes.

    Attributes:
        broken: messages with names of nodes that could not be read.
    """

    def __init__(self, participant: DomainParticipant) -> None:
        self._participant = participant
        self.discovery = Discovery(participant)
        self._names: RawReader | None = None
        self._owners: dict[bytes, str] = {}
        self._enclaves: dict[str, str] = {}
        self.broken = 0

    def look(self) -> None:
        """Take what was told since the last look."""
        self.discovery.look()
        if self._names is None:
            teller = next((end for end in self.found() if end.topic == NODE_NAMES and end.writes), None)
            self._names = None if teller is None else self._reader(teller)
        for message in self._names.take() if self._names is not None else ():
            self._take_names(message.data, self._enclave(message.writer))

    def found(self) -> tuple[Found, ...]:
        """Endpoints of DDS that are there now."""
        return tuple(self.discovery.endpoints.values())

    def node_of(self, key: bytes) -> str | None:
        """The node of an endpoint; None when nobody told it."""
        return self._owners.get(key)

    def nodes(self) -> tuple[Node, ...]:
        """Nodes that were named, by name."""
        return tuple(Node(name, enclave=self._enclaves.get(name, "")) for name in sorted(set(self._enclaves)))

    def endpoints(self) -> Iterator[Endpoint]:
        """Yield endpoints of ROS."""
        for end in sorted(self.found()):
            told = meaning(end.topic, end.writes)
            if told is None or told.role is None:
                continue
            digest = user_data(end.qos).get("typehash")
            kind, node = ros_type(end.type), self.node_of(end.key)
            yield Endpoint(told.role, told.name, kind, node, digest, None, model_qos(end.qos), UNSEEN)

    def gaps(self) -> Iterator[Gap]:
        """Yield what keeps nodes from being known."""
        ends = [end for end in self.found() if meaning(end.topic, end.writes) is not None]
        nameless = sum(end.key not in self._owners for end in ends)
        if nameless:
            yield Gap(f"{nameless} of {len(ends)} endpoints", "nobody told which node they belong to")
        if self.broken:
            yield Gap(NODE_NAMES, f"{self.broken} message(s) are of no layout that is known")

    def _reader(self, teller: Found) -> RawReader:
        qos = DdsQos(
            Policy.Reliability.Reliable(duration(milliseconds=100)),
            Policy.Durability.TransientLocal,
            Policy.History.KeepAll,
        )
        return RawReader(self._participant, NODE_NAMES, teller.type, teller.type_id, qos)

    def _take_names(self, data: bytes, enclave: str) -> None:
        nodes = nodes_of(data)
        if nodes is None:
            self.broken += 1
        for node in nodes or ():
            self._enclaves[node.name] = enclave
            self._owners.update(dict.fromkeys(node.keys, node.name))

    def _enclave(self, writer: int) -> str:
        key = self._names.writer_key(writer) if self._names is not None else None
        end = self.discovery.endpoints.get(key or b"")
        qos = self.discovery.participants.get(end.participant) if end is not None else None
        return user_data(qos).get("enclave", "") if qos is not None else ""
