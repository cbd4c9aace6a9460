"""Times in source: chrono literals, ROS durations, numbers, computed from constants and parameter defaults.

Sources: API pages of `std::chrono`, roscpp/rclcpp/rospy/rclpy `Duration` and `Rate`.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ecm_parsers.numbers import real
from ecm_parsers.source.expr import Call, Expr, Member, Name, Number, Op

from ecm_extract.infer.held import Held
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.walk import last_of
from ecm_extract.link.folding.data import data_of
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env

MAX_DEPTH = 8
_SECONDS: Mapping[str, float] = MappingProxyType(
    {
        "h": 3600.0,
        "hours": 3600.0,
        "min": 60.0,
        "minutes": 60.0,
        "s": 1.0,
        "seconds": 1.0,
        "ms": 1e-3,
        "milliseconds": 1e-3,
        "us": 1e-6,
        "microseconds": 1e-6,
        "ns": 1e-9,
        "nanoseconds": 1e-9,
        "duration": 1.0,
        "durationFromSec": 1.0,
        "from_seconds": 1.0,
        "from_sec": 1.0,
        "Duration": 1.0,
        "WallDuration": 1.0,
        "duration_cast": 1.0,
        "from_nanoseconds": 1e-9,
        "static_cast": 1.0,
    }
)
_KEYWORDS: Mapping[str, float] = MappingProxyType({"seconds": 1.0, "nanoseconds": 1e-9, "sec": 1.0})


def seconds_of(expr: Expr | None, env: Env, folder: Folder, depth: int = 0) -> float | None:
    """Return a duration in seconds; a bare number counts as seconds. None when it is not known."""
    if expr is None or depth > MAX_DEPTH or not folder.steps.take(env):
        return None
    with folder.steps:
        return _seconds(expr, env, folder, depth)


def counted(expr: Expr | None, env: Env, folder: Folder) -> int | float | None:
    """Return the number that a duration is asked for: `duration.count()` in its own unit, `.seconds()`, `.toSec()`."""
    if not isinstance(expr, Call) or not isinstance(expr.callee, Member) or expr.args:
        return None
    made = expr.callee.base
    seconds = seconds_of(made, env, folder) if isinstance(made, Call) else None
    if seconds is None or not isinstance(made, Call):
        return None
    if expr.callee.name in {"seconds", "toSec", "to_sec"}:
        return seconds
    return _in_unit(seconds, made) if expr.callee.name == "count" else None


def _in_unit(seconds: float, made: Call) -> int | float | None:
    """Seconds in the unit of a duration of chrono: a whole number but for `duration<double>`."""
    name = last_of(made.callee)
    if name == "duration":
        return seconds if len(made.types) == 1 and made.types[0] in {"double", "float"} else None
    unit = _SECONDS.get(last_name(made.types[0]) if name == "duration_cast" and made.types else name)
    return None if unit is None else round(seconds / unit)


def _seconds(expr: Expr, env: Env, folder: Folder, depth: int) -> float | None:
    if isinstance(expr, Number):
        return float(expr.value)
    if isinstance(expr, Call):
        return _call(expr, env, folder, depth)
    if isinstance(expr, Op) and len(expr.operands) == 2 and expr.op in {"/", "*", "+", "-"}:
        left, right = (seconds_of(part, env, folder, depth + 1) for part in expr.operands)
        return None if left is None or right is None else _computed(expr.op, left, right)
    if isinstance(expr, Name | Member):
        return _variable(expr, env, folder, depth)
    return None


def _call(expr: Call, env: Env, folder: Folder, depth: int) -> float | None:
    factor = _SECONDS.get(last_of(expr.callee))
    if factor is None:
        return _period(expr, env, folder, depth) or _plain(expr, env, folder)
    total = 0.0
    for keyword, unit in _KEYWORDS.items():
        given = next((value for key, value in expr.keywords if key == keyword), None)
        amount = seconds_of(given, env, folder, depth + 1) if given is not None else 0.0
        if amount is None:
            return None
        total += amount * unit
    if not expr.args:
        return total or None
    amount = seconds_of(expr.args[0], env, folder, depth + 1)
    rest = seconds_of(expr.args[1], env, folder, depth + 1) if len(expr.args) == 2 else 0.0
    return None if amount is None or rest is None else total + amount * factor + rest * 1e-9


def _period(expr: Call, env: Env, folder: Folder, depth: int) -> float | None:
    """`rate.period()` is one divided by what the rate was made with."""
    callee = expr.callee
    if not isinstance(callee, Member) or callee.name != "period" or not isinstance(callee.base, Name | Member):
        return None
    found = {_made_with(held, folder, depth) for held in folder.origins.of(callee.base, env)}
    hertz = found.pop() if len(found) == 1 else None
    return 1 / hertz if hertz else None


def _made_with(held: Held, folder: Folder, depth: int) -> float | None:
    """What a rate is made with; None for what shows no such thing."""
    if held.how != "value" or held.env is None or not isinstance(held.expr, Call) or not held.expr.args:
        return None
    return seconds_of(held.expr.args[-1], held.env, folder, depth + 1)


def _variable(expr: Name | Member, env: Env, folder: Folder, depth: int) -> float | None:
    """A variable that may hold several durations, or one that is not known, has none that is known."""
    given = folder.origins.of(expr, env)
    if not given or any(held.how != "value" for held in given):
        return _plain(expr, env, folder)
    found = {seconds_of(held.expr, held.env, folder, depth + 1) for held in given if held.env is not None}
    return found.pop() if len(found) == 1 else None


def _plain(expr: Expr, env: Env, folder: Folder) -> float | None:
    value = data_of(expr, env, folder)
    return real(str(value)) if isinstance(value, int | float | str) and not isinstance(value, bool) else None


def _computed(operator: str, left: float, right: float) -> float | None:
    if operator == "/":
        return left / right if right else None
    return {"*": left * right, "+": left + right, "-": left - right}[operator]
