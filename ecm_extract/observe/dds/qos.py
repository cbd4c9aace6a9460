"""Policies of an endpoint of DDS in the words of a contract."""

from __future__ import annotations

from typing import Any, Final

from cyclonedds.core import Policy
from ecm_checker.contract import Qos

INFINITE_NS: Final = 9223372036854775807
# Discovery need not carry them (DDSI-RTPS 9.6.3), and other vendors do not: what is seen is then a default.
UNSEEN: Final = ("history", "depth")
_NS_PER_MS: Final = 1e6
_DURABILITY: Final = {
    "Volatile": "volatile",
    "TransientLocal": "transient_local",
    "Transient": "transient",
    "Persistent": "persistent",
}
_LIVELINESS: Final = {
    "Automatic": "automatic",
    "ManualByParticipant": "manual_by_node",
    "ManualByTopic": "manual_by_topic",
}


def model_qos(qos: Any) -> Qos:
    """What discovery told of an endpoint; a policy that was not told has the default of DDS."""
    liveliness = _policy(qos, Policy.Liveliness)
    return Qos(
        reliability="reliable" if _word(_policy(qos, Policy.Reliability)) == "Reliable" else "best_effort",
        durability=_DURABILITY.get(_word(_policy(qos, Policy.Durability)), "volatile"),
        deadline_ms=_milliseconds(getattr(_policy(qos, Policy.Deadline), "deadline", None)),
        lifespan_ms=_milliseconds(getattr(_policy(qos, Policy.Lifespan), "lifespan", None)),
        liveliness=_LIVELINESS.get(_word(liveliness), "automatic"),
        lease_ms=_milliseconds(getattr(liveliness, "lease_duration", None)),
    )


def user_data(qos: Any) -> dict[str, str]:
    """`key=value;` pairs of the user data: the enclave of a participant, the type hash of an endpoint."""
    data = getattr(_policy(qos, Policy.Userdata), "data", b"") or b""
    pairs = (part.partition("=") for part in data.decode("utf-8", "replace").split(";"))
    return {key: value for key, equals, value in pairs if equals}


def _policy(qos: Any, kind: Any) -> Any:
    return qos[kind] if kind in qos else None  # noqa: SIM401  a Qos has no get


def _word(policy: Any) -> str:
    """The last part of `Reliability.Reliable`: policies without a value have a class of their own each."""
    return type(policy).__name__.rpartition(".")[2]


def _milliseconds(duration_ns: int | None) -> float | None:
    return None if duration_ns is None or duration_ns >= INFINITE_NS else duration_ns / _NS_PER_MS
