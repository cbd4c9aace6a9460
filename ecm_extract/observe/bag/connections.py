"""Connections of a bag as endpoints and channels."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final, NamedTuple

from ecm_checker.contract import Qos

from ecm_extract.observe.hearing.heard import Channel
from ecm_extract.observe.hearing.layouts import begins_with_header
from ecm_extract.observe.model import Endpoint

_MS: Final = 1000.0
_INFINITE_S: Final = 9_000_000_000
_ZERO: Final = 0


class Recorded(NamedTuple):
    """A connection of a bag: its publishers, and where its messages come from."""

    endpoints: tuple[Endpoint, ...]
    channel: Channel


def recorded(connection: Any, ros: int) -> Recorded:
    """What a connection of the reader of rosbags says."""
    definition = connection.msgdef.data or None
    node = connection.ext.callerid or None if ros == 1 else None
    profiles = [] if ros == 1 else [_qos(each) for each in connection.ext.offered_qos_profiles]
    plain = Endpoint("publisher", connection.topic, connection.msgtype, node, connection.digest or None, definition)
    latched = bool(connection.ext.latching) if ros == 1 else any(_keeps(each) for each in profiles)
    channel = Channel(
        connection.topic,
        node,
        connection.msgtype,
        "ros1" if ros == 1 else "cdr",
        begins_with_header(connection.msgtype, definition),
        latched,
    )
    return Recorded(tuple(_with_qos(plain, profiles)), channel)


def _with_qos(plain: Endpoint, profiles: list[Qos]) -> Iterator[Endpoint]:
    """One publisher for each profile that was offered; without any it is one whose QoS is not known."""
    if not profiles:
        yield plain
    for qos in profiles:
        yield Endpoint(plain.role, plain.name, plain.type, plain.node, plain.hash, plain.definition, qos, ("depth",))


def _keeps(qos: Qos) -> bool:
    return qos.durability == "transient_local"


def _qos(profile: Any) -> Qos:
    return Qos(
        reliability=profile.reliability.name.lower(),
        durability=profile.durability.name.lower(),
        history=profile.history.name.lower(),
        depth=profile.depth,
        deadline_ms=_milliseconds(profile.deadline),
        lifespan_ms=_milliseconds(profile.lifespan),
        liveliness=profile.liveliness.name.lower(),
        lease_ms=_milliseconds(profile.liveliness_lease_duration),
    )


def _milliseconds(time: Any) -> float | None:
    """ROS writes infinity as the largest duration, and as zero where nothing was asked for."""
    if time.sec >= _INFINITE_S or (time.sec == _ZERO and time.nsec == _ZERO):
        return None
    return float(time.sec * _MS + time.nsec / 1e6)
