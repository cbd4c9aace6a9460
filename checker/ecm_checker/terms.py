"""Free-form values of a contract, as people and extractors write them, in one shape.

None stays None: undeclared is not the same as none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any, Final

import msgspec

from ecm_checker.contract import Value
from ecm_checker.units import number, quantity

_ARROW: Final = re.compile(r"\s*(?:->|→|=>)\s*")
_ALIASES: Final[Mapping[str, str]] = {
    "motion_permission": "motion",
    "restricted_zone_access": "restricted_zone",
    "human_prox": "human_proximity",
    "cpu": "cpu_cores",
    "ram": "memory",
    "control_frequency_hz": "ctrl_hz",
    "control_hz": "ctrl_hz",
}
_RETRY_NAME: Final = re.compile(r"(?:retry_)?(once|twice|never|none|no_retry|forever|unlimited)")
_LONGEST: Final = 200
_RETRY_COUNTS: Final = {"once": 1.0, "twice": 2.0, "never": 0.0, "none": 0.0, "no_retry": 0.0}


class Field(msgspec.Struct, frozen=True):
    """One field of an input or output schema; what is not declared is None."""

    name: str
    type: str | None = None
    unit: str | None = None
    frame: str | None = None
    optional: bool = False


class Spec(msgspec.Struct, frozen=True):
    """A sensor or actuator: `kind@mount` or `kind@30Hz`.

    Attributes:
        text: as written.
        kind: what it is.
        mount: where it is; empty when it does not matter.
        rate_hz: least rate; 0 when none is asked for.
    """

    text: str
    kind: str
    mount: str = ""
    rate_hz: float = 0.0


class Retry(msgspec.Struct, frozen=True):
    """How often it tries again (infinite: without bound) and how."""

    count: float
    strategy: str = ""


class Escalation(msgspec.Struct, frozen=True):
    """`condition -> action`."""

    condition: str
    action: str


def texts(value: Value | None) -> tuple[str, ...] | None:
    """A list of texts: of a list, of the true keys of a mapping, or of one text."""
    return None if value is None else tuple(_texts(value.value))


def pairs(value: Value | None) -> dict[str, Any] | None:
    """A mapping: of a mapping, of a list of mappings, of `key: value` texts or of bare names (true)."""
    return None if value is None else dict(_pairs(value.value))


def normal_pairs(value: Value | None) -> dict[str, Any] | None:
    """Like `pairs`, with keys in lower case and the names of the paper's listings made one."""
    found = pairs(value)
    return None if found is None else normal_keys(found)


def normal_keys(mapping: Mapping[str, Any]) -> dict[str, Any]:
    """Keys in lower case, different spellings of one key made one."""
    return {_ALIASES.get(key.lower(), key.lower()): item for key, item in mapping.items()}


def word(value: Value | None) -> str | None:
    """One word; None when undeclared, empty when it is something else."""
    if value is None:
        return None
    return value.value if isinstance(value.value, str) else ""


def fields(data: object) -> tuple[Field, ...]:
    """Fields of a schema: `[{name: type}]`, `[{name: {type, unit, frame, optional}}]` or `{name: type}`."""
    return tuple(_field(name, item) for name, item in _pairs(data))


@lru_cache(maxsize=4096)
def spec(text: str) -> Spec:
    """Read `force_torque@wrist` or `wrist_rgbd@30Hz`."""
    kind, _, rest = text.partition("@")
    rate = quantity(rest) if rest else None
    if rate is not None and rate.dimension in {"frequency", ""}:
        return Spec(text, kind.strip(), "", rate.value)
    return Spec(text, kind.strip(), rest.strip())


def specs(value: Value | None) -> tuple[Spec, ...] | None:
    """Sensors or actuators of a contract."""
    found = texts(value)
    return None if found is None else tuple(map(spec, found))


def retry(value: Value | None) -> Retry | None:
    """`{max: 2, strategy: x}`, `retry_once`, or a bare strategy (at least once)."""
    if value is None:
        return None
    if isinstance(value.value, str):
        named = _RETRY_NAME.fullmatch(value.value)
        return Retry(_RETRY_COUNTS.get(named[1], float("inf"))) if named else Retry(1.0, value.value[:_LONGEST])
    if isinstance(value.value, int | float):
        return Retry(float(value.value))
    found = dict(_pairs(value.value))
    count = number(found.get("max", found.get("count", 1)))
    return Retry(float("inf") if count is None else count, str(found.get("strategy", ""))[:_LONGEST])


def escalations(value: Value | None) -> tuple[Escalation, ...] | None:
    """`[condition -> action]` or `{condition: action}`."""
    if value is None:
        return None
    if isinstance(value.value, dict):
        return tuple(Escalation(str(key), str(item)) for key, item in value.value.items())
    return tuple(map(_escalation, _texts(value.value)))


def rates(value: Value | None) -> dict[str, float]:
    """Hertz by what acts: `{/odom: 50}`, `{publisher /odom: 50 Hz}` or `{/odom: {hz: 50}}`."""
    found = {}
    for key, item in _pairs(value.value) if value is not None else ():
        amount = number(item.get("hz")) if isinstance(item, dict) else number(item)
        if amount is not None:
            found[key] = amount
    return found


def _escalation(text: str) -> Escalation:
    parts = _ARROW.split(text, maxsplit=1)
    return Escalation(parts[0].strip(), parts[1].strip() if len(parts) > 1 else "")


def _field(name: str, item: object) -> Field:
    if not isinstance(item, dict):
        return Field(name, item if isinstance(item, str) else None)
    return Field(
        name,
        _optional_text(item.get("type")),
        _optional_text(item.get("unit")),
        _optional_text(item.get("frame")),
        item.get("optional") is True,
    )


def _optional_text(item: object) -> str | None:
    return item if isinstance(item, str) else None


def _texts(data: object) -> Iterator[str]:
    if isinstance(data, dict):
        yield from (str(key) for key, item in data.items() if item is not False)
    elif isinstance(data, list | tuple):
        for item in data:
            yield from _texts(item)
    elif isinstance(data, str):
        yield data


def _pairs(data: object) -> Iterator[tuple[str, Any]]:
    if isinstance(data, dict):
        yield from ((str(key), item) for key, item in data.items())
    elif isinstance(data, list | tuple):
        for item in data:
            yield from _pairs(item)
    elif isinstance(data, str) and data:
        key, found, rest = data.partition(":")
        yield (key.strip(), rest.strip()) if found else (data.strip(), True)
