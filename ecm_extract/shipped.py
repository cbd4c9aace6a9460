"""Tables that ship with the package: what it knows of public names, as data beside the code that asks for it."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Any, TypeVar

import msgspec

_Record = TypeVar("_Record")


@cache
def shipped(path: str) -> Mapping[str, Any]:
    """Return a table, read once.

    Args:
        path: of its file from the folder of the package: `link/naming/carriers.toml`.
    """
    text = resources.files("ecm_extract").joinpath(*path.split("/")).read_text("utf-8")
    return tomllib.loads(text)


def shipped_as(path: str, kind: type[_Record]) -> _Record:
    """Return a table as records of a type, which a test of the whole package holds it to."""
    return msgspec.convert(shipped(path), kind)


@cache
def shipped_names(path: str, row: str) -> frozenset[str]:
    """Return the names that a row of a table lists under `names`."""
    return frozenset(shipped(path)[row]["names"])
