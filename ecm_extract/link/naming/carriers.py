"""Classes of libraries whose objects carry the node handle that they are made with."""

from __future__ import annotations

from functools import cache

from ecm_extract.shipped import shipped_names


@cache
def carriers() -> frozenset[str]:
    """Return the last names of those classes."""
    return shipped_names("link/naming/carriers.toml", "carriers")
