"""What kind of module a class is, by the bases it derives from."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.program import Program
from ecm_extract.shipped import shipped


@cache
def _bases() -> Mapping[str, tuple[str, ...]]:
    return {kind: tuple(row["bases"]) for kind, row in shipped("link/index/module_bases.toml").items()}


def class_kind(cls: Cls, program: Program) -> str | None:
    """Return `node`, `nodelet`, `controller` or `hardware`; None for a class that is none of them."""
    for name in program.base_names(cls):
        for kind, bases in _bases().items():
            if any(_is(name, base) for base in bases):
                return kind
    return None


def takes_undeclared(cls: Cls, program: Program) -> bool:
    """Tell whether the base of a class makes a node that takes parameters which it does not declare."""
    return bool(_row(cls, program).get("undeclared"))


def declared_by_base(cls: Cls, program: Program) -> frozenset[str]:
    """Return the parameters that the base of a class declares before it, whose defaults are not those of the class."""
    return frozenset(_row(cls, program).get("declared", ()))


def _row(cls: Cls, program: Program) -> Mapping[str, Any]:
    kind = class_kind(cls, program)
    return shipped("link/index/module_bases.toml")[kind] if kind is not None else {}


_MANAGED = frozenset({"LifecycleNode", "ControllerInterface", "ChainableControllerInterface"}) | {
    "SystemInterface",
    "ActuatorInterface",
    "SensorInterface",
}
_MANAGED_ALIAS = "rclpy.lifecycle.Node"  # rclpy/lifecycle/__init__.py hands LifecycleNode on under this name too


def is_managed(cls: Cls, program: Program) -> bool:
    """Tell whether a class follows the ROS 2 lifecycle: it works in the state active only."""
    return any(last_name(name) in _MANAGED or _is(name, _MANAGED_ALIAS) for name in program.base_names(cls))


def is_node_base(name: str) -> bool:
    """Tell whether a base class is a node's: its first constructor argument is the node's name."""
    return any(_is(name, base) for base in _bases()["node"]) or last_name(name) in {"Node", "LifecycleNode"}


def _is(name: str, base: str) -> bool:
    if "::" not in base and "." not in base:
        return last_name(name) == base
    separator = "." if "." in base else "::"
    return name == base or name.endswith(separator + base) or (base.endswith(separator + name) and separator in name)
