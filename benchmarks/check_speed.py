"""Speed of the checker on one core: pairs per second, and a system of 1,000 modules.

    python benchmarks/check_speed.py

Prints a figure and the one to reach for each; ends with status 1 when one is missed.
"""

from __future__ import annotations

import sys
import time

from ecm_checker.contract import (
    Behavior,
    Contract,
    Evidence,
    Identity,
    Interface,
    Permissions,
    Qos,
    Recovery,
    Resources,
    Role,
    Signature,
    Source,
    Value,
)
from ecm_checker.operations.compose import compose
from ecm_checker.operations.system import system
from ecm_checker.profiles import Embodiment, Policy, Profiles
from ecm_checker.view import view

PAIRS_PER_SECOND = 10_000
SYSTEM_SECONDS = 2.0
MODULES = 1_000
ENDPOINTS = 20
TOPICS = 4_000

PROFILES = Profiles(
    Embodiment(
        sensors=("lidar",), actuators=("base",), compute={"cpu_cores": 10_000}, control_hz=1000.0, latency_ms=1.0
    ),
    Policy(physical={"motion": True}, data=("read:*",), network=False, audit="full"),
)


def endpoint(role: Role, number: int, line: int) -> Interface:
    name = f"/robot{number % 40}/topic_{number}"
    kind = f"demo_msgs/msg/Type{number % 7}"
    qos = Qos("reliable", "volatile", "keep_last", 10)
    return Interface(role, name, name, kind, qos, None, "literal", (Evidence("src/node.cpp", line),))


def module(number: int) -> Contract:
    """A module with endpoints on topics that few others share, and all six dimensions declared."""
    interfaces = []
    for at in range(ENDPOINTS):
        role: Role = "publisher" if at % 2 else "subscriber"
        interfaces.append(endpoint(role, (number * 31 + at * 97) % TOPICS, at + 1))
    return Contract(
        Identity(f"ecm.package{number}.node", f"package{number}", "node", "1.0.0", Source(None, None, "."), 2),
        Signature(
            interfaces=tuple(interfaces),
            input_schema=Value([{"pose": {"type": "Pose3D", "unit": "m", "frame": "map"}}], "declared"),
            output_schema=Value([{"pose": {"type": "Pose3D", "unit": "m", "frame": "map"}}], "declared"),
        ),
        Behavior(Value(["confidence >= 0.90"], "declared"), Value(["confidence >= 0.95"], "declared")),
        Resources(
            sensors=Value(["lidar"], "declared"),
            actuators=Value(["base"], "declared"),
            compute=Value({"cpu_cores": 1}, "declared"),
            exclusive_locks=Value([f"joint{number}/position"], "declared"),
        ),
        Permissions(
            physical=Value({"motion": True}, "declared"),
            data=Value(["read:map"], "declared"),
            network=Value(False, "declared"),
        ),
        Recovery(
            failure_modes=Value({"lost": "degraded"}, "declared"),
            rollback_state=Value("home", "declared"),
            retry=Value({"max": 1}, "declared"),
            safe_stop=Value(["brake"], "declared"),
            escalation=Value(["lost -> planner"], "declared"),
        ),
    )


def pairs_per_second(contracts: list[Contract]) -> float:
    views = [view(contract) for contract in contracts]
    compose(views[0], views[1], PROFILES)
    start, count = time.process_time(), 0
    while time.process_time() - start < 2.0:
        for step in (1, 7):
            for at in range(0, len(views) - step, 2):
                compose(views[at], views[at + step], PROFILES)
                count += 1
    return count / (time.process_time() - start)


def system_seconds(contracts: list[Contract]) -> float:
    start = time.process_time()
    system(contracts, PROFILES, together=True)
    return time.process_time() - start


def main() -> int:
    contracts = [module(number) for number in range(MODULES)]
    rate, seconds = pairs_per_second(contracts), system_seconds(contracts)
    print(f"pairwise checks per second, one core: {rate:,.0f} (to reach: {PAIRS_PER_SECOND:,})")
    print(
        f"system of {MODULES:,} modules with {ENDPOINTS} endpoints each: {seconds:.2f} s (to reach: {SYSTEM_SECONDS} s)"
    )
    return 0 if rate >= PAIRS_PER_SECOND and seconds <= SYSTEM_SECONDS else 1


if __name__ == "__main__":
    sys.exit(main())
