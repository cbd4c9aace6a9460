"""How source files of C and C++ are called (source_suffixes.toml)."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Final

from ecm_extract.shipped import shipped

_ROWS: Final = shipped("source_suffixes.toml")
COMPILED: Final = frozenset(_ROWS["compiled"])
"""Of files that a target compiles."""
INCLUDED: Final = frozenset((*_ROWS["headers"], *_ROWS["implementations"]))
"""Of headers, and of the bodies of templates that headers include."""
CPP: Final = COMPILED | INCLUDED
"""Of all of them, in lower case."""


def is_included(path: str) -> bool:
    """Tell whether a file is one that others include, by what it is called."""
    return PurePosixPath(path).suffix.lower() in INCLUDED
