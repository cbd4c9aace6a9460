"""What folding asks about ROS parameters."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Protocol

from ecm_parsers.source.expr import Expr, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value


class ParameterReads(Protocol):
    """What the linker knows of parameters: which call reads one, and the defaults that were declared."""

    def read(self, call: Invocation) -> tuple[Expr, Expr | None] | None:
        """Return (name, default) when a call gives the value of a parameter."""

    def knows(self, name: str) -> bool:
        """Tell whether a row of the tables is about calls of a name."""

    def all_written(self, func: Func) -> Mapping[str, Sequence[tuple[int, Expr, Expr | None]]]:
        """Return variable -> (statement, name, default) of the calls of a function that write a parameter to it."""

    def written(self, func: Func, target: str) -> list[tuple[int, Expr, Expr | None]]:
        """Return (statement, name, default) of the calls of a function that write a parameter to a variable."""

    def read_into(self, func: Func, name: Expr) -> list[str]:
        """Return the variables that a function reads a parameter into, by its name as written."""

    def forget(self) -> None:
        """Drop what was remembered, since more is known now."""

    def members(self, cls: Cls, target: str) -> list[tuple[Func, int, Expr, Expr | None]]:
        """Return (method, statement, name, default) of the calls of a class that write a parameter to a member."""

    def is_declared(self, name: str, package: str) -> bool:
        """Tell whether a package declares a parameter, with a default or without."""

    def default(self, name: str, package: str, owners: Sequence[Cls | File] = ()) -> tuple[Expr, Env] | Value | None:
        """Return the declared default of a parameter: by its owners first, then by the package where it has one."""


def read_into(
    written: Mapping[str, Sequence[tuple[int, Expr, Expr | None]]],
) -> Mapping[int, Sequence[tuple[Expr, Expr, Expr | None]]]:
    """Return statement -> (variable, name, default) of what is read into variables, not into their fields."""
    found: dict[int, list[tuple[Expr, Expr, Expr | None]]] = defaultdict(list)
    for target, entries in written.items():
        for at, name, default in entries:
            if not target.startswith("."):
                found[at].append((Name(target), name, default))
    return found
