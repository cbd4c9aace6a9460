"""Faults of this program: what a function or class makes it stumble over must not cost what is known of others."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.tree import FileDiagnostic, Unread

CODE: Final = "function-left-out"


class Faults:
    """Keeps the functions and classes at which work ended with an error that nobody expected, and tells of them."""

    def __init__(self) -> None:
        self._found: dict[Func | Cls, str] = {}

    @contextmanager
    def of(self, unit: Func | Cls) -> Iterator[None]:
        """Within it an error ends the work on a function or class, and nothing else. With ECM_DEBUG it is raised."""
        try:
            yield
        except Exception as error:
            if os.environ.get("ECM_DEBUG"):
                raise
            self._found.setdefault(unit, type(error).__name__)

    def told(self) -> Iterator[FileDiagnostic]:
        """Yield what is to be told of them: each is a gap, since what it declares may not be told."""
        for unit, kind in self._found.items():
            path = unit.file.path
            text = (
                f"`{unit.fact.name}` could not be followed to its end ({kind}): what it declares may be missing. "
                "This is a fault of ecm-extract: report it, with what ECM_DEBUG=1 prints."
            )
            yield FileDiagnostic("error", CODE, path, unit.fact.line, text, Unread(path, "stopped"))
