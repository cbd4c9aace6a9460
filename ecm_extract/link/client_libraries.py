"""Packages that make endpoints for others: in a tree that holds their sources, what these declare is nobody's."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources


@cache
def _packages() -> frozenset[str]:
    text = (resources.files("ecm_extract.link") / "client_libraries.toml").read_text("utf-8")
    return frozenset(tomllib.loads(text)["packages"]["names"])


def is_client_library(package: str) -> bool:
    """Tell whether a package is a client library or a library of its kind, by its name."""
    return package in _packages()
