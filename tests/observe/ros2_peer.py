"""A participant that looks like ROS 2: mangled names, types without type information, `ros_discovery_info`.

As an rmw does, it tells no XTypes information: topics are made by the C library that the wheel brings, of arrays of
bytes that hold what a test wants to send.
"""

from __future__ import annotations

import ctypes as ct
import struct
from typing import Any

from dds_loopback import DOMAIN

# isort: split
from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.internal import DDS
from cyclonedds.qos import _CQos
from cyclonedds.util import duration

RELIABLE = Policy.Reliability.Reliable(duration(seconds=1))
BEST_EFFORT = Policy.Reliability.BestEffort
_ADDRESS, _ARRAY, _OF_BYTES, _END = 0x01000000, 0x00080000, 0x00000100, 0


class _Meta(ct.Structure):
    _fields_ = [("data", ct.c_void_p), ("size", ct.c_uint32)]


class _Descriptor(ct.Structure):
    """`dds_topic_descriptor_t` of dds_public_impl.h."""

    _fields_ = [
        ("size", ct.c_uint32),
        ("align", ct.c_uint32),
        ("flags", ct.c_uint32),
        ("keys_count", ct.c_uint32),
        ("name", ct.c_char_p),
        ("keys", ct.c_void_p),
        ("ops_count", ct.c_uint32),
        ("ops", ct.POINTER(ct.c_uint32)),
        ("meta", ct.c_char_p),
        ("type_information", _Meta),
        ("type_mapping", _Meta),
        ("representations", ct.c_uint32),
    ]


class Peer:
    """A process of ROS 2 with any number of nodes; keep it as long as its endpoints shall live."""

    def __init__(self, enclave: str = "/", domain: int = DOMAIN) -> None:
        user_data = Policy.Userdata(f"enclave={enclave};".encode())
        self.participant = DomainParticipant(domain, qos=Qos(user_data))
        self._library: Any = ct.CDLL(DDS._dll_handle._name)  # a handle whose functions take any argument
        self._kept: list[Any] = []
        self._nodes: dict[str, tuple[list[int], list[int]]] = {}

    def close(self) -> None:
        """Leave with every endpoint."""
        self._library.dds_delete(self.participant._ref)

    def publisher(self, node: str, topic: str, kind: str, *policies: Any, size: int = 48) -> Writer:
        return Writer(self, self._endpoint(node, f"rt{topic}", kind, size, policies, writes=True))

    def subscriber(self, node: str, topic: str, kind: str, *policies: Any, size: int = 48) -> int:
        return self._endpoint(node, f"rt{topic}", kind, size, policies, writes=False)

    def server(self, node: str, name: str, kind: str) -> None:
        self._endpoint(node, f"rq{name}Request", f"{kind}_Request", 8, (RELIABLE,), writes=False)
        self._endpoint(node, f"rr{name}Reply", f"{kind}_Response", 8, (RELIABLE,), writes=True)

    def client(self, node: str, name: str, kind: str) -> None:
        self._endpoint(node, f"rq{name}Request", f"{kind}_Request", 8, (RELIABLE,), writes=True)
        self._endpoint(node, f"rr{name}Reply", f"{kind}_Response", 8, (RELIABLE,), writes=False)

    def tell_nodes(self, gid: int = 16) -> None:
        """Send `ros_discovery_info` in the layout of Iron and later (16) or of Humble and before (24)."""
        body = bytes(gid) + struct.pack("<I", len(self._nodes))
        for name, (readers, writers) in self._nodes.items():
            namespace, _, last = name.rpartition("/")
            body = _text(_text(body, namespace or "/"), last)
            for ends in (readers, writers):
                body = _aligned(body) + struct.pack("<I", len(ends))
                body += b"".join(self._key(end).ljust(gid, b"\0") for end in ends)
        self.say_of_nodes(_aligned(body))

    def say_of_nodes(self, body: bytes) -> None:
        """Send anything at all as `ros_discovery_info`."""
        kind = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"
        policies = (RELIABLE, Policy.Durability.TransientLocal, Policy.History.KeepLast(1))
        Writer(self, self._raw("ros_discovery_info", kind, len(body), policies, writes=True)).write(body)

    def _endpoint(self, node: str, topic: str, kind: str, size: int, policies: Any, *, writes: bool) -> int:
        package, family, name = kind.split("/")
        end = self._raw(topic, f"{package}::{family}::dds_::{name}_", size, policies, writes=writes)
        self._nodes.setdefault(node, ([], []))[writes].append(end)
        return end

    def _raw(self, topic: str, kind: str, size: int, policies: Any, *, writes: bool) -> int:
        ops = (ct.c_uint32 * 4)(_ADDRESS | _ARRAY | _OF_BYTES, 0, size, _END)
        name = kind.encode()
        descriptor = _Descriptor(size=size, align=1, name=name, ops_count=2, ops=ops, meta=b"")
        self._kept += [ops, name, descriptor]
        create = self._library.dds_create_writer if writes else self._library.dds_create_reader
        made = self._library.dds_create_topic(self.participant._ref, ct.byref(descriptor), topic.encode(), None, None)
        assert made > 0, made
        qos = ct.cast(_CQos.qos_to_cqos(Qos(*policies)), ct.c_void_p) if policies else None
        end = int(create(self.participant._ref, made, qos, None))
        assert end > 0, end
        return end

    def _key(self, end: int) -> bytes:
        guid = (ct.c_uint8 * 16)()
        assert self._library.dds_get_guid(end, guid) == 0
        return bytes(guid)


class Writer:
    """Sends bytes as the body of a message."""

    def __init__(self, peer: Peer, end: int) -> None:
        self._peer = peer
        self._end = end

    def write(self, body: bytes) -> None:
        assert self._peer._library.dds_write(self._end, body) == 0

    def close(self) -> None:
        self._peer._library.dds_delete(self._end)


def _text(body: bytes, text: str) -> bytes:
    return _aligned(body) + struct.pack("<I", len(text) + 1) + text.encode() + b"\0"


def _aligned(body: bytes) -> bytes:
    return body + b"\0" * (-len(body) % 4)
