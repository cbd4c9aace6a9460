"""300 endpoints of a DDS domain: how long until they are seen, and until they are compared with 30 contracts.

python benchmarks/observe_graph.py [--endpoints 300]

The peer is a process of its own on loopback that is up before the clock starts, as a robot is.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
import time
from collections.abc import Iterator
from typing import Any

from ecm_checker.contract import Contract, Identity, Interface, Qos, Signature, Source
from path_a.qos import LOOPBACK

SEEN_AND_COMPARED_S = 2.0
COMPARED_MS = 50.0
NODES = 30
TYPE = "geometry_msgs/msg/Twist"


def names(node: int, each: int) -> Iterator[tuple[str, str]]:
    """Role and name of the two endpoints of a node with one number."""
    yield "publisher", f"/n{node}/out{each}"
    yield "subscriber", f"/n{(node + 1) % NODES}/out{each}"


def contracts(pairs: int) -> list[Contract]:
    found = []
    for node in range(NODES):
        ends = tuple(
            Interface(role, name, name, TYPE, Qos(reliability="reliable"), None, "literal", ())  # type: ignore[arg-type]
            for each in range(pairs)
            for role, name in names(node, each)
        )
        identity = Identity(f"ecm.robot.n{node}", "robot", "node", "1.0.0", Source(None, None, "."), 2)
        found.append(Contract(identity, Signature(ends)))
    return found


def peer(domain: int, pairs: int, ready: Any, over: Any) -> None:
    from cyclonedds.core import Policy, Qos
    from cyclonedds.domain import DomainParticipant
    from cyclonedds.idl import make_idl_struct
    from cyclonedds.idl.types import float64
    from cyclonedds.pub import DataWriter
    from cyclonedds.sub import DataReader
    from cyclonedds.topic import Topic
    from cyclonedds.util import duration

    twist = make_idl_struct("Twist", "geometry_msgs::msg::dds_::Twist_", {"x": float64})
    participant = DomainParticipant(domain)
    qos = Qos(Policy.Reliability.Reliable(duration(seconds=1)))
    kept = []
    for node in range(NODES):
        for each in range(pairs):
            for role, name in names(node, each):
                make = DataWriter if role == "publisher" else DataReader
                kept.append(make(participant, Topic(participant, f"rt{name}", twist), qos=qos))
    ready.set()
    over.wait()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--endpoints", type=int, default=300)
    pairs = parser.parse_args().endpoints // (2 * NODES)
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    domain = 100 + os.getpid() % 60
    process = multiprocessing.get_context("spawn")
    ready, over = process.Event(), process.Event()
    other = process.Process(target=peer, args=(domain, pairs, ready, over))
    other.start()
    ready.wait()
    try:
        measure(domain, contracts(pairs))
    finally:
        over.set()
        other.join()


def measure(domain: int, promised: list[Contract]) -> None:
    from ecm_extract.observe.compare import compare
    from ecm_extract.observe.dds import watch_dds
    from ecm_extract.observe.watch import Watch

    start = time.perf_counter()
    *_, seen = watch_dds(domain, 0, once=True)
    looked = time.perf_counter() - start
    findings = compare(Watch(seen, promised))
    whole = time.perf_counter() - start
    start = time.perf_counter()
    compare(Watch(seen, promised))
    compared = (time.perf_counter() - start) * 1000
    print(f"{len(seen.endpoints)} endpoints: seen in {looked:.2f} s, seen and compared in {whole:.2f} s")
    print(f"compared again in {compared:.1f} ms, {len(findings)} findings")
    sys.exit(whole > SEEN_AND_COMPARED_S or compared > COMPARED_MS)


if __name__ == "__main__":
    main()
