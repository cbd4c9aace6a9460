"""What a call does to a variable."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ecm_parsers.source.expr import Call

Kind = Literal["changed", "lost", "out", "handed", "reached", "swapped", "found"]


@dataclass(frozen=True, slots=True, eq=False)
class Effect:
    """A variable, by its key, that a call changes or may change.

    `found`: it becomes what the call gives, where that is a name that it looks for.

    Attributes:
        name: the parameter that it is there, of `out`; the variable that it changes places with, of `swapped`.
    """

    kind: Kind
    key: str
    call: Call
    name: str = ""
