"""Parameters that calls write to variables: `get_parameter("rate", rate_)`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

from ecm_parsers.source.expr import Expr


class ReadInto(NamedTuple):
    """A call that writes a parameter to a variable.

    Attributes:
        at: the statement of the call.
        out: what it writes to: a variable, or a field of an object.
        name: of the parameter.
        default: what is written where nobody set it; None where that is not stated.
    """

    at: int
    out: Expr
    name: Expr
    default: Expr | None


Reads: TypeAlias = Mapping[int, Sequence[ReadInto]]
"""The reads of a function by their statements."""
