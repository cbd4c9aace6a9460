"""QoS: every policy, offered and asked for, with real DDS between two processes."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Mapping, Sequence
from typing import Any

from ecm_checker.contract import Interface, Qos

from path_a.predictions import Predicted, check, contract, manifest
from path_a.row import Case, NotMeasured, Observed

SAMPLES = 80
GAP_S = 0.005
_RULES = {"BEH001", "BEH002", "BEH003", "BEH004", "BEH005"}
LOOPBACK = (
    '<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>'
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    '<Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>'
)
_POLICIES = {2: "durability", 4: "deadline", 8: "liveliness", 11: "reliability"}


def measure(repetitions: int) -> Sequence[Case]:
    try:
        import cyclonedds  # noqa: F401
    except ImportError:
        message = "Eclipse Cyclone DDS is not installed: pip install 'ecm-extract[dds]'"
        raise NotMeasured(message) from None
    found, offers = predicted(), offered()
    asks = _topics(contract("qos_pairs", "reader"), "subscriber")
    runs = [_run(offers, asks) for _ in range(repetitions)]
    return [case(topic, found, [run[topic] for run in runs]) for topic in offers]


def predicted() -> Sequence[Predicted]:
    """What speaks against pairs of the fixture."""
    sides = manifest("qos_pairs", "writer"), manifest("qos_pairs", "reader")
    return [each for each in check("compose", *sides) if each.rule in _RULES]


def offered() -> Mapping[str, Qos]:
    """Topics of the pairs, with what the writer offers."""
    return _topics(contract("qos_pairs", "writer"), "publisher")


def _topics(module: Any, role: str) -> Mapping[str, Qos]:
    found: list[Interface] = [each for each in module.signature.interfaces if each.role == role]
    return {each.name: each.qos or Qos() for each in found}


def case(
    topic: str, found: Sequence[Predicted], runs: Sequence[tuple[int, str]], where: str = "QoS", missing: str = ""
) -> Case:
    """A pair: what is predicted of it, and how many samples came in each run, with the policy that was refused."""
    against = [each.rule for each in found if f"{topic}:" in each.message]
    expected = "none arrives" if against else "all arrive"
    observed = tuple(
        Observed(
            f"{count} of {SAMPLES}" + (f", refused for {policy}" if policy else ""),
            count == 0 if against else count == SAMPLES,
        )
        for count, policy in runs
    )
    prediction = f"{expected} ({', '.join(against) or 'nothing against it'})"
    return Case(f"{where} {topic.strip('/')}", prediction, observed, missing)


def _run(offers: Mapping[str, Qos], asks: Mapping[str, Qos]) -> Mapping[str, tuple[int, str]]:
    """One repetition: a process that reads and one that writes, on a domain of their own."""
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    domain = 160 + os.getpid() % 60
    process = multiprocessing.get_context("spawn")
    results, ready = process.Queue(), process.Event()
    reader = process.Process(target=_read, args=(domain, asks, ready, results))
    writer = process.Process(target=_write, args=(domain, offers, ready))
    reader.start()
    writer.start()
    found: Mapping[str, tuple[int, str]] = results.get(timeout=60)
    writer.join()
    reader.join()
    return found


def _write(domain: int, offers: Mapping[str, Qos], ready: Any) -> None:
    from cyclonedds.domain import DomainParticipant
    from cyclonedds.pub import DataWriter
    from cyclonedds.topic import Topic

    twist = _twist()
    participant = DomainParticipant(domain)
    writers = [
        DataWriter(participant, Topic(participant, f"rt{name}", twist), qos=_dds(qos)) for name, qos in offers.items()
    ]
    ready.wait(30)
    time.sleep(1.0)
    for number in range(SAMPLES):
        for writer in writers:
            writer.write(twist(x=float(number)))
        time.sleep(GAP_S)
    time.sleep(1.0)


def _read(domain: int, asks: Mapping[str, Qos], ready: Any, results: Any) -> None:
    from cyclonedds.domain import DomainParticipant
    from cyclonedds.sub import DataReader
    from cyclonedds.topic import Topic

    twist = _twist()
    participant = DomainParticipant(domain)
    readers = {
        name: DataReader(participant, Topic(participant, f"rt{name}", twist), qos=_dds(qos))
        for name, qos in asks.items()
    }
    ready.set()
    counts = dict.fromkeys(readers, 0)
    end = time.monotonic() + 3.5 + SAMPLES * GAP_S
    while time.monotonic() < end:
        for name, reader in readers.items():
            counts[name] += sum(isinstance(sample, twist) for sample in reader.take(N=200))
        time.sleep(0.01)
    refused = {name: reader.get_requested_incompatible_qos_status() for name, reader in readers.items()}
    policies = {
        name: _POLICIES.get(status.last_policy_id, "") if status.total_count else "" for name, status in refused.items()
    }
    results.put({name: (counts[name], policies[name]) for name in readers})


def _twist() -> Any:
    from cyclonedds.idl import make_idl_struct
    from cyclonedds.idl.types import float64

    return make_idl_struct("Twist", "geometry_msgs::msg::dds_::Twist_", {"x": float64})


def _dds(qos: Qos) -> Any:
    """The policies of a contract, as an rmw gives them to DDS; what it leaves open has the default of ROS 2."""
    from cyclonedds.core import Policy
    from cyclonedds.core import Qos as DdsQos
    from cyclonedds.util import duration

    policies = [
        Policy.Reliability.BestEffort
        if qos.reliability == "best_effort"
        else Policy.Reliability.Reliable(duration(seconds=1)),
        Policy.Durability.TransientLocal if qos.durability == "transient_local" else Policy.Durability.Volatile,
        Policy.History.KeepAll if qos.history == "keep_all" else Policy.History.KeepLast(qos.depth or 10),
    ]
    if qos.deadline_ms is not None:
        policies.append(Policy.Deadline(duration(milliseconds=qos.deadline_ms)))
    lease = duration(milliseconds=qos.lease_ms) if qos.lease_ms is not None else duration(infinite=True)
    manual = qos.liveliness == "manual_by_topic"
    policies.append(Policy.Liveliness.ManualByTopic(lease) if manual else Policy.Liveliness.Automatic(lease))
    return DdsQos(*policies)
