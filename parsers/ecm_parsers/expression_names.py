"""What expressions may name: functions, constants, and the methods of their values.

Sources: `xacro.create_global_symbols`, roslaunch `substitution_args._eval`; what only grows without bound is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Any

from ecm_parsers.expression_limits import bounded_range, factorial, power
from ecm_parsers.expression_set import KINDS, Members, is_of, kind_of

_MATH = (
    "acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh degrees dist erf erfc exp exp2 expm1 fabs "
    "floor fmod frexp fsum gamma gcd hypot isclose isfinite isinf isnan isqrt ldexp lgamma log log10 log1p log2 modf "
    "nextafter radians remainder sin sinh sqrt tan tanh trunc ulp"
)


def _rounded(number: Any, digits: int | None = None) -> Any:
    return round(number, digits) if digits is None or abs(digits) < 30 else number  # of a double


def _powered(base: Any, exponent: Any) -> float:
    """What `math.pow` gives, which is the one that xacro and roslaunch know."""
    return float(power(base, exponent))


def _mapped(function: Callable[..., Any], *items: Iterable[Any]) -> list[Any]:
    return [function(*each) for each in zip(*items, strict=False)]


FUNCTIONS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        **{name: getattr(math, name) for name in _MATH.split() if hasattr(math, name)},
        "factorial": factorial,
        "pow": _powered,
        "abs": abs,
        "divmod": divmod,
        "int": int,
        "float": float,
        "str": str,
        "repr": repr,
        "bool": bool,
        "ord": ord,
        "len": len,
        "min": min,
        "max": max,
        "round": _rounded,
        "sum": sum,
        "sorted": sorted,
        "reversed": lambda items: list(reversed(items)),
        "list": list,
        "tuple": tuple,
        "set": Members,
        "frozenset": Members,
        "isinstance": is_of,
        "type": kind_of,
        "dict": dict,
        "any": any,
        "all": all,
        "range": bounded_range,
        "zip": lambda *items: list(zip(*items, strict=False)),
        "enumerate": lambda items, start=0: list(enumerate(items, start)),
        "map": _mapped,
        "filter": lambda function, items: list(filter(function, items)),
    }
)
"""Functions by name; what Python makes as it goes is a list here."""

CONSTANTS: Mapping[str, Any] = MappingProxyType(
    {"pi": math.pi, "e": math.e, "tau": math.tau, "inf": math.inf, "nan": math.nan, "true": True, "false": False}
    | dict(KINDS)
)
MODULES = frozenset({"math", "xacro", "python", "np", "numpy"})
"""Names before a dot that say where a function is from."""

_TEXT_METHODS = (
    "lower upper swapcase casefold title capitalize strip lstrip rstrip removeprefix removesuffix split rsplit "
    "splitlines partition rpartition join startswith endswith replace find rfind index rindex count format zfill ljust "
    "rjust center isalnum isalpha isascii isdecimal isdigit isidentifier islower isnumeric isspace istitle isupper"
)
METHODS: Mapping[type, frozenset[str]] = MappingProxyType(
    {
        str: frozenset(_TEXT_METHODS.split()),
        dict: frozenset({"get", "keys", "values", "items", "copy"}),
        list: frozenset({"index", "count", "copy"}),
        tuple: frozenset({"index", "count"}),
        Members: frozenset({"union", "intersection", "difference", "issubset", "issuperset", "isdisjoint", "copy"}),
        float: frozenset({"is_integer"}),
        int: frozenset({"bit_length"}),
    }
)
"""Methods by the kind of their owner; none of them changes it."""
