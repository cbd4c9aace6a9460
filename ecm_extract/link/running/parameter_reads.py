"""What folding asks about ROS parameters."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

from ecm_parsers.source.expr import Expr

from ecm_extract.infer.read_into import ReadInto, Reads
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value


class MethodRead(NamedTuple):
    """A call in a method that writes a parameter to a member of its object, or to a field of another one."""

    method: Func
    read: ReadInto


class ParameterRead(NamedTuple):
    """The name of a parameter that a call reads, and its default; of a fallback what is declared holds before it.

    `tells`: the call gives a variable the value, and itself whether there was one, or what else a helper returns;
    `node`: what it is called on; `plainly`: it is one of the client library.
    """

    name: Expr
    default: Expr | None
    is_fallback: bool = False
    tells: bool = False
    node: Expr | None = None
    plainly: bool = False


class ParameterReads(Protocol):
    """What the linker knows of parameters: which call reads one, and the defaults that were declared."""

    def read(self, call: Invocation) -> ParameterRead | None:
        """Return what a call reads that gives the value of a parameter."""

    def knows(self, name: str) -> bool:
        """Tell whether a row of the tables is about calls of a name."""

    def all_written(self, func: Func) -> Mapping[str, Sequence[ReadInto]]:
        """Return the calls of a function that write a parameter, by what they write to."""

    def written(self, func: Func, target: str) -> Sequence[ReadInto]:
        """Return the calls of a function that write a parameter to a variable, or `.field` to that of an object."""

    def read_into(self, func: Func, name: Expr) -> list[str]:
        """Return the variables that a function reads a parameter into, by its name as written."""

    def forget(self) -> None:
        """Drop what was remembered, since more is known now."""

    def members(self, cls: Cls, target: str) -> Sequence[MethodRead]:
        """Return the calls of a class that write a parameter to a member."""

    def is_declared(self, name: str, package: str) -> bool:
        """Tell whether a package declares a parameter, with a default or without."""

    def is_given_instead(self, name: str, owners: Sequence[Cls | File]) -> bool:
        """Tell whether a parameter has not the default that its call states, as its node is given something else."""

    def default(self, name: str, package: str, owners: Sequence[Cls | File] = ()) -> tuple[Expr, Env] | Value | None:
        """Return the declared default of a parameter: by its owners first, then by the package where it has one."""


def read_into(written: Mapping[str, Sequence[ReadInto]]) -> Reads:
    """Return by their statements what is read into variables, and into their fields."""
    found: dict[int, list[ReadInto]] = defaultdict(list)
    for read in (each for reads in written.values() for each in reads):
        found[read.at].append(read)
    return found
