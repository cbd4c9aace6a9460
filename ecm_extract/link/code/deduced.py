"""What `auto` stands for where a variable begins with a new object of a standard class: `auto x = std::string();`."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Call, Expr, Name

from ecm_extract.link.code.spelling import plain

_MADE: Final = frozenset({"std::string", "std::vector"})


def deduced_type(written: str, value: Expr | None) -> str:
    """Return the type of a variable as written; of `auto` that of the object that it is made with, where it shows."""
    if plain(written) != "auto" or not isinstance(value, Call) or not isinstance(value.callee, Name):
        return written
    made = value.callee.id.removeprefix("::")
    if plain(made) not in _MADE:
        return written
    return f"{made}<{', '.join(value.types)}>" if value.types else made
