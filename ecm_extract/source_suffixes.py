"""How source files of C and C++ are called (source_suffixes.toml)."""

from __future__ import annotations

from typing import Final

from ecm_extract.shipped import shipped

_ROWS: Final = shipped("source_suffixes.toml")
COMPILED: Final = frozenset(_ROWS["compiled"])
"""Of files that a target compiles."""
INCLUDED: Final = frozenset((*_ROWS["headers"], *_ROWS["implementations"]))
"""Of headers, and of the bodies of templates that headers include."""
CPP: Final = COMPILED | INCLUDED
"""Of all of them, in lower case."""
