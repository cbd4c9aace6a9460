"""Properties of the whole build, which people use as variables that every folder sees.

They are kept among the variables, under a name that no variable can have.
"""

from __future__ import annotations

from collections.abc import Sequence

from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.look import Look


def held(name: str) -> str:
    """Return the name under which a property is kept."""
    return f"\x06{name}"


def set_property(args: list[str], look: Look) -> Sequence[Change]:
    """`set_property(GLOBAL [APPEND | APPEND_STRING] PROPERTY name values...)`; those of targets set no variable."""
    if args[:1] != ["GLOBAL"] or "PROPERTY" not in args[:-1]:
        return []
    at = args.index("PROPERTY")
    name, text = held(args[at + 1]), ";".join(args[at + 2 :])
    before = look.built_up(name)
    if "APPEND_STRING" in args[:at]:
        return [Change(name, before + text)]
    return [Change(name, f"{before};{text}" if before and "APPEND" in args[:at] else text)]


def get_property(args: list[str], look: Look) -> Sequence[Change]:
    """`get_property(NAME GLOBAL PROPERTY name)`; those of targets and folders are not known."""
    if args[1:3] == ["GLOBAL", "PROPERTY"] and len(args) == 4 and look.has(held(args[3])):
        return [Change(args[0], look.get(held(args[3])))]
    return not_known(args[0]) if args else []
