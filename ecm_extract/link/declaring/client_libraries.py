"""Packages that make endpoints for others: in a tree that holds their sources, what these declare is nobody's."""

from __future__ import annotations

from functools import cache

from ecm_extract.shipped import shipped_names


@cache
def _packages() -> frozenset[str]:
    return shipped_names("link/declaring/client_libraries.toml", "packages")


def is_client_library(package: str) -> bool:
    """Tell whether a package is a client library or a library of its kind, by its name."""
    return package in _packages()
