"""Classes of libraries whose objects carry the node handle that they are made with."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources


@cache
def carriers() -> frozenset[str]:
    """Return the last names of those classes."""
    text = (resources.files("ecm_extract.link") / "carriers.toml").read_text("utf-8")
    return frozenset(tomllib.loads(text)["carriers"]["names"])
