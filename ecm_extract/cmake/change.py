"""What a command does to variables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import msgspec

from ecm_extract.cmake.look import Look
from ecm_extract.cmake.state import Where
from ecm_extract.cmake.values import unknown


class Change(msgspec.Struct, frozen=True):
    """A variable that a command sets, or unsets (`text` None), and which scopes see it."""

    name: str
    text: str | None
    where: Where = "here"


Setter: TypeAlias = Callable[[list[str], Look], Sequence[Change]]
"""A command that sets variables: from its evaluated arguments and the variables that it reads."""


def not_known(name: str) -> list[Change]:
    """Return the change of a variable to what only a build knows."""
    return [Change(name, unknown(name))]
