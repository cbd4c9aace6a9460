"""Permissions: a commander that the policy does not let command. No middleware at hand here denies anything."""

from __future__ import annotations

from collections.abc import Sequence

from path_a.predictions import check, manifest, rules
from path_a.row import FIXTURES, Case

_WHY = (
    "the wheel of Cyclone DDS brings no DDS security plugins, and Debian has no SROS 1: "
    "no middleware at hand denies anything"
)


def measure(_repetitions: int) -> Sequence[Case]:
    policy = str(FIXTURES / "policies" / "ward.yaml")
    found = check("install", manifest("cmd_vel_robot", "teleop"), "--policy", policy)
    return [Case("commander without permission", f"its access to /cmd_vel is denied ({rules(found)})", missing=_WHY)]
