"""Policies of two ends that can never match, as DDS decides it (request against offer)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ecm_checker.contract import Qos
from ecm_checker.qos import Fits, Setting, duration_fits, level_fits

_POLICIES: Mapping[str, Fits] = MappingProxyType(
    {
        "reliability": level_fits,
        "durability": level_fits,
        "deadline_ms": duration_fits,
        "liveliness": level_fits,
        "lease_ms": duration_fits,
    }
)


def misfits(offered: Qos, wanted: Qos) -> Iterator[str]:
    """Yield the names of policies whose request the offer does not meet."""
    for policy, fits in _POLICIES.items():
        if not fits(Setting(getattr(offered, policy), True), Setting(getattr(wanted, policy), True)):
            yield policy
