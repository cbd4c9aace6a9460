"""Values of QoS policies: the policy that a constant names, durations in milliseconds."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Member, Name, Number, Op

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name

_WORDS = (
    *("best_effort", "reliable", "transient_local", "volatile", "keep_last", "keep_all"),
    *("automatic", "manual_by_topic", "best_available", "system_default"),
)
_NUMBERED = {
    "reliability": ("system_default", "reliable", "best_effort"),
    "durability": ("system_default", "transient_local", "volatile"),
    "history": ("system_default", "keep_last", "keep_all"),
    "liveliness": ("system_default", "automatic"),
}
"""Source: rmw/types.h, from zero on."""
BY_KEY = "get_from_short_key"
"""The method of enumerations of rclpy that gives an enumerator by its name in lower case (rclpy/qos.py)."""
_ENUMERATION = "Policy"
_UNITS = {"s": 1000.0, "ms": 1.0, "us": 0.001, "ns": 1e-6, "min": 60000.0, "h": 3600000.0}


def policy_word(expr: Expr) -> str:
    """Return the policy that a constant names: `ReliabilityPolicy.BEST_EFFORT`, `ReliabilityPolicy::BestEffort`.

    Variables begin in lower case: what is called `reliable` may hold any policy, or tell whether it is that one.
    """
    text = last_name(expr.id if isinstance(expr, Name) else expr.name if isinstance(expr, Member) else "")
    return policy_called(text) if text[:1].isupper() else ""


def policy_called(name: str) -> str:
    """Return the policy of a name, with or without what stands before it in C."""
    squeezed = name.replace("_", "").lower()
    return next((word for word in _WORDS if squeezed.endswith(word.replace("_", ""))), "")


def policy_asked(expr: Expr) -> Expr | None:
    """Return the name by which a policy is asked for: `Reliability[name]`, `Reliability.get_from_short_key(name)`."""
    if isinstance(expr, Op) and expr.op == "[]" and len(expr.operands) == 2:
        owner, name = expr.operands
    elif isinstance(expr, Call) and expr.callee == Name("getattr") and len(expr.args) >= 2:
        owner, name = expr.args[:2]
    elif isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.name == BY_KEY and expr.args:
        owner, name = expr.callee.base, expr.args[0]
    else:
        return None
    return name if last_name(dotted_name(owner)).rpartition(".")[2].endswith(_ENUMERATION) else None


def policy_of_number(policy: str, expr: Number) -> str:
    """Return the policy that rclpy makes of a number."""
    names = _NUMBERED.get(policy, ())
    return names[int(expr.value)] if expr.value in range(len(names)) else "unknown"


def milliseconds(expr: Expr) -> float | None:
    """Return a duration as written in C++ or Python, None for what is no constant."""
    if not isinstance(expr, Call):
        return None
    name = last_name(dotted_name(expr.callee) or (expr.callee.id if isinstance(expr.callee, Name) else ""))
    keywords = dict(expr.keywords)
    if name == "Duration" and keywords:
        seconds, nanoseconds = keywords.get("seconds"), keywords.get("nanoseconds")
        total = seconds.value * 1000.0 if isinstance(seconds, Number) else 0.0
        return total + (nanoseconds.value * 1e-6 if isinstance(nanoseconds, Number) else 0.0)
    if len(expr.args) == 1 and isinstance(expr.args[0], Number):
        factor = {"milliseconds": 1.0, "seconds": 1000.0, "nanoseconds": 1e-6, "from_seconds": 1000.0}.get(
            name, _UNITS.get(name)
        )
        return expr.args[0].value * factor if factor is not None else None
    return milliseconds(expr.args[0]) if len(expr.args) == 1 else None
