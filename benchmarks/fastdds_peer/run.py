"""A peer of another vendor: what observe sees of a participant of Fast DDS, beside what it is.

python benchmarks/fastdds_peer/run.py

Builds peer.cpp, a program of ours, against the Fast DDS of Debian (libfastrtps-dev) and watches it for some seconds.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from shutil import which

sys.path.insert(0, str(Path(__file__).parents[1]))

from path_a.qos import LOOPBACK

from ecm_extract.observe.model import Endpoint, Observation

_SOURCE = Path(__file__).with_name("peer.cpp")
_HEADER = Path("/usr/include/fastdds/dds/domain/DomainParticipant.hpp")
_SECONDS = 8.0
_PEER_SECONDS = "40"
_STRING = "std_msgs/msg/String"


def main() -> None:
    if which("g++") is None or not _HEADER.exists():
        sys.exit("not measured: needs apt-get install g++ libfastrtps-dev")
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    domain = 30 + os.getpid() % 60
    with tempfile.TemporaryDirectory() as folder:
        program = f"{folder}/peer"
        subprocess.run(["g++", "-O0", "-w", str(_SOURCE), "-o", program, "-lfastrtps", "-lfastcdr"], check=True)
        peer = subprocess.Popen([program, str(domain), _PEER_SECONDS])
        try:
            seen = _watched(domain)
        finally:
            peer.kill()
            peer.wait()
    wrong = list(_differences(seen))
    print("\n".join(wrong) or "names, types, hash, policies, rate and incidents are those of the peer")
    sys.exit(bool(wrong))


def _watched(domain: int) -> Observation:
    from ecm_extract.observe.dds import watch_dds

    *_, seen = watch_dds(domain, _SECONDS)
    return seen


def _differences(seen: Observation) -> Iterator[str]:
    """The depth that it offers is not told on the wire, so none may be claimed."""
    ends = {end.name: end for end in seen.endpoints}
    chatter, goal = ends.get("/chatter"), ends.get("/arm/goal")
    yield from _of(chatter, "publisher", {"reliability": "best_effort", "durability": "volatile", "deadline_ms": 100.0})
    yield from _of(goal, "subscriber", {"reliability": "reliable", "durability": "transient_local", "lease_ms": 2000.0})
    if chatter is not None and not (chatter.hash or "").startswith("RIHS01_df668c"):
        yield f"/chatter: hash {chatter.hash}"
    rates = [stream.hz or 0 for stream in seen.streams if stream.topic == "/chatter"]
    print(f"{len(seen.endpoints)} endpoints; /chatter at {', '.join(f'{rate:.1f}' for rate in rates) or 'no'} Hz")
    if not any(rates):
        yield "/chatter: nothing was heard"
    if not seen.gaps:
        yield "nobody told the names of nodes, and that is no gap"


def _of(end: Endpoint | None, role: str, policies: dict[str, object]) -> Iterator[str]:
    if end is None or end.qos is None:
        yield f"no {role} was seen"
        return
    if (end.role, end.type) != (role, _STRING) or not {"history", "depth"} <= set(end.unseen):
        yield f"{end.name}: {end}"
    for policy, value in policies.items():
        if getattr(end.qos, policy) != value:
            yield f"{end.name}: {policy} is {getattr(end.qos, policy)}, the peer has {value}"


if __name__ == "__main__":
    main()
