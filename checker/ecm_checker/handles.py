"""Verbs of methods that take something, and of those that give it back."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Any


@cache
def pairs() -> Mapping[str, str]:
    """Return how names of methods begin that give back, by how those begin that take."""
    found: Mapping[str, str] = _table()["pairs"]
    return found


@cache
def verbs() -> tuple[str, ...]:
    """Return how names of methods of either kind begin."""
    return tuple({*pairs(), *pairs().values()})


@cache
def plain_returns() -> frozenset[str]:
    """Return the types of results that hold nothing."""
    return frozenset(_table()["returns"]["nothing"])


@cache
def _table() -> Mapping[str, Any]:
    return tomllib.loads((resources.files("ecm_checker") / "data" / "handles.toml").read_text("utf-8"))
