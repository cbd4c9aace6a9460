"""Names of which parameters give a part once the parameters are known."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ecm_checker.hub.local_name import OpenPart, Parts

MAX_ITEMS = 60


def filled(name: Parts, parameter: Callable[[str], Any]) -> list[Parts]:
    """Return a name with what parameters give put in, once for each item of a list.

    Args:
        name: its parts.
        parameter: gives the value of a parameter, None when it is not set.
    """
    found: list[Parts] = [()]
    for part in name:
        ways = [(part,)] if isinstance(part, str) or part.of != "parameter" else _given(part, parameter)
        found = [(*head, *way) for head in found for way in ways][:MAX_ITEMS]
    return found


def _given(part: OpenPart, parameter: Callable[[str], Any]) -> list[Parts]:
    given = parameter(part.label)
    values = given[:MAX_ITEMS] if isinstance(given, list) else [] if given is None else [given]
    texts: list[Parts] = [(str(value),) for value in values if not isinstance(value, list | dict)]
    return texts or filled(part.default, parameter)
