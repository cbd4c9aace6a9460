"""Packages that `find_package` looks for."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_extract.cmake.keywords import split

_FIND_WORDS = frozenset(
    {
        "REQUIRED",
        "QUIET",
        "COMPONENTS",
        "OPTIONAL_COMPONENTS",
        "CONFIG",
        "MODULE",
        "EXACT",
        "NO_MODULE",
        "HINTS",
    }
)


def found_packages(args: Sequence[str]) -> list[str]:
    """Return the packages that the arguments of `find_package` name: those of catkin are its components too."""
    names = list(args[:1])
    if names == ["catkin"]:
        groups = split(tuple(args[1:]), _FIND_WORDS)
        # catkin takes components after REQUIRED too.
        after = ("COMPONENTS", "OPTIONAL_COMPONENTS", "REQUIRED")
        names += [name for word in after for name in groups.get(word, [])]
    return list(dict.fromkeys(names))
