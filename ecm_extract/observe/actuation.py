"""Which topics move the robot: the table of the checker."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources


def moves(topic: str, kind: str | None) -> bool:
    """Whether messages of a type on a topic move the robot; an untold type may be the one that does."""
    kinds = _topics().get(topic.rpartition("/")[2], ())
    return bool(kinds) and (kind is None or kind in kinds)


@cache
def _topics() -> Mapping[str, list[str]]:
    text = (resources.files("ecm_checker") / "data" / "actuation.toml").read_text("utf-8")
    table: dict[str, list[str]] = tomllib.loads(text)["topics"]
    return table
