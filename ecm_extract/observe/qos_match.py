"""Policies of two ends that can never match, as DDS decides it (request against offer)."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Qos
from ecm_checker.match.qos_fit import POLICIES, Setting


def misfits(offered: Qos, wanted: Qos) -> Iterator[str]:
    """Yield the names of policies whose request the offer does not meet."""
    for policy, fits in POLICIES.items():
        if not fits(Setting(getattr(offered, policy), True), Setting(getattr(wanted, policy), True)):
            yield policy
