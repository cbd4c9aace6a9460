"""Names of C++ classes as descriptions and macros write them: `pkg::A`, `Factory<pkg::A>`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

_NAME: Final = re.compile(r"[\w:]+")


def joined(text: str) -> str:
    """Return a type without white space."""
    return "".join(text.split())


def named_in(text: str) -> Iterator[str]:
    """Yield the class that a type names, and what a factory template makes of it."""
    head, _, inner = joined(text).partition("<")
    for name in (head, inner.partition("<")[0].partition(">")[0]):
        found = name.strip(":&*")
        if found:
            yield found


def last_of(name: str) -> str:
    """Return a class without its namespaces."""
    return name.rpartition("::")[2]


def parts_of(text: str) -> frozenset[str]:
    """Return the last parts of all names in a type."""
    return frozenset(last_of(name) for name in _NAME.findall(text))


def differ(first: str, second: str) -> bool:
    """Tell whether two types have other names: a namespace may be left out, and a plain name may be an alias."""
    ours, theirs = _NAME.findall(joined(first)), _NAME.findall(joined(second))
    return bool(ours) and len(ours) == len(theirs) and not all(map(_agree, ours, theirs))


def _agree(first: str, second: str) -> bool:
    longer, shorter = sorted((first.strip(":"), second.strip(":")), key=len, reverse=True)
    return longer == shorter or longer.endswith(f"::{shorter}")
