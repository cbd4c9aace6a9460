"""Types of members as others see them: a class that stands within the class of a member has that in front."""

from __future__ import annotations

import re
from typing import Final

from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.program import Program

_ALONE: Final = re.compile(r"(?<![\w:])[A-Za-z_]\w*(?!\w|\s*::)")
"""A name with none in front of it and none behind."""


def seen_from_outside(written: str, cls: Cls | None, program: Program) -> str:
    """Return the type of a member of a class as it is written outside of that: `std::vector<Drive::Limits>`.

    Args:
        written: the type as the class, or a base of it, writes it.
        cls: the class.
        program: knows all classes.
    """
    if cls is None or not written or cls.file.language != "cpp":
        return written

    def whole(name: re.Match[str]) -> str:
        found = program.class_named(name[0], cls.file, cls.qualified)
        return found.qualified if found is not None and found.fact.scope else name[0]

    return _ALONE.sub(whole, written)
