"""Limits of the numbers of both languages, where sources name them."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Final

from ecm_extract.link.code.spelling import plain

_SINGLE_MAX: Final = 3.4028234663852886e38
_SINGLE_MIN: Final = 1.1754943508222875e-38
_BITS: Final[Mapping[str, int]] = MappingProxyType(
    {f"int{bits}_t": bits for bits in (8, 16, 32, 64)} | {"int": 32, "short": 16, "long": 64}
)
_UNSIGNED: Final[Mapping[str, int]] = MappingProxyType(
    {f"u{name}": bits for name, bits in _BITS.items()} | {"unsigned": 32, "size_t": 64}
)
_REAL: Final[Mapping[str, Mapping[str, float]]] = MappingProxyType(
    {
        "double": {"max": sys.float_info.max, "min": sys.float_info.min, "epsilon": sys.float_info.epsilon},
        "float": {"max": _SINGLE_MAX, "min": _SINGLE_MIN, "epsilon": 2.0**-23},
    }
)


def limit(path: str, types: Sequence[str]) -> int | float | None:
    """Return what `std::numeric_limits<T>::max()` gives; None for other calls and for what is no finite number.

    Args:
        path: what is called, without template arguments.
        types: the template arguments.
    """
    head, _, which = path.rpartition("::")
    if head not in {"std::numeric_limits", "numeric_limits"} or len(types) != 1:
        return None
    name = plain(types[0]).rpartition("::")[2]
    if name in _REAL:
        return -_REAL[name]["max"] if which == "lowest" else _REAL[name].get(which)
    return _whole(name, "min" if which == "lowest" else which)


def _whole(name: str, which: str) -> int | None:
    signed, unsigned = _BITS.get(name), _UNSIGNED.get(name)
    if which == "min":
        return -(2 ** (signed - 1)) if signed is not None else 0 if unsigned is not None else None
    if which != "max":
        return None
    return 2 ** (signed - 1) - 1 if signed is not None else 2**unsigned - 1 if unsigned is not None else None
