"""How source files of C and C++ are called (source_suffixes.toml)."""

from __future__ import annotations

import tomllib
from importlib import resources
from typing import Final

_ROWS: Final[dict[str, list[str]]] = tomllib.loads(
    (resources.files("ecm_extract") / "source_suffixes.toml").read_text("utf-8")
)
COMPILED: Final = frozenset(_ROWS["compiled"])
"""Of files that a target compiles."""
INCLUDED: Final = frozenset((*_ROWS["headers"], *_ROWS["implementations"]))
"""Of headers, and of the bodies of templates that headers include."""
CPP: Final = COMPILED | INCLUDED
"""Of all of them, in lower case."""
