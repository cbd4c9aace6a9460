"""Whether the DDS policies that are offered meet those that are asked for.

Source: ROS 2 documentation, "Quality of Service settings"; unset policies have the default of rclcpp and rclpy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final, NamedTuple

from ecm_checker.contract import Qos

_DEFAULTS: Final = {"reliability": "reliable", "durability": "volatile", "liveliness": "automatic"}
# These adapt to the other side, or to the middleware: nothing can be said.
_OPEN: Final = frozenset({"best_available", "system_default", "unknown"})
_LEVELS: Final = {
    "best_effort": 0,
    "reliable": 1,
    "volatile": 0,
    "transient_local": 1,
    "transient": 2,
    "persistent": 3,
    "automatic": 0,
    "manual_by_node": 1,
    "manual_by_topic": 1,
}


class Setting(NamedTuple):
    """A policy of an endpoint; `sure` when source or a person sets it."""

    value: str | float | None
    sure: bool


Fits = Callable[[Setting, Setting], bool]


def policy_of(qos: Qos | None, policy: str) -> Setting:
    """The value of a policy: as set, else the default."""
    value = getattr(qos, policy) if qos is not None else None
    if value is None:
        return Setting(_DEFAULTS.get(policy), False)
    return Setting(value, qos is not None and policy not in qos.defaulted)


def level_fits(offered: Setting, wanted: Setting) -> bool:
    """Whether a policy of levels (reliability, durability, liveliness) is at least what is asked for."""
    if offered.value in _OPEN or wanted.value in _OPEN:
        return True
    return _LEVELS.get(str(offered.value), 9) >= _LEVELS.get(str(wanted.value), 0)


def duration_fits(offered: Setting, wanted: Setting) -> bool:
    """Whether a duration (deadline, lease) is at most what is asked for; None is infinite."""
    if not isinstance(wanted.value, int | float):
        return True
    return isinstance(offered.value, int | float) and offered.value <= wanted.value


def qos_fits(offered: Qos | None, wanted: Qos | None) -> bool:
    """Whether every policy that is offered meets what is asked for; of a side that tells none nothing is said."""
    if offered is None or wanted is None:
        return True
    return all(fits(policy_of(offered, name), policy_of(wanted, name)) for name, fits in POLICIES.items())


POLICIES: Final[Mapping[str, Fits]] = {
    "reliability": level_fits,
    "durability": level_fits,
    "deadline_ms": duration_fits,
    "liveliness": level_fits,
    "lease_ms": duration_fits,
}
