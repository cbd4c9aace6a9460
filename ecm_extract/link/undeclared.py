"""Nodes that take parameters which they do not declare: what they read is a parameter all the same."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Call, Constant

from ecm_extract.link.units import Func

_OPTIONS: Final = frozenset({"allow_undeclared_parameters", "automatically_declare_parameters_from_overrides"})
"""Options of `rclcpp::NodeOptions` and of the nodes of rclpy."""
_TRUE: Final = Constant("true")


def takes_undeclared(func: Func) -> bool:
    """Tell whether a function makes a node that takes parameters which it does not declare."""
    return any(_says_so(call) for calls in func.calls for call in calls)


def _says_so(call: Call) -> bool:
    name = getattr(call.callee, "name", "")
    by_name = any(key in _OPTIONS and value == _TRUE for key, value in call.keywords)
    return by_name or (name in _OPTIONS and call.args == (_TRUE,))
