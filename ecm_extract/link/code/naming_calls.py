"""Functions of client libraries that make a name of another; see naming_calls.toml."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

from ecm_extract.link.code.spelling import last_name
from ecm_extract.shipped import shipped


@cache
def _table() -> Mapping[str, Mapping[str, Sequence[str]]]:
    return shipped("link/code/naming_calls.toml")


def is_resolver(name: str) -> bool:
    """Tell whether a function of a last name applies remaps and namespaces at run time."""
    return name in _table()["resolving"]["names"]


def gives_name(path: str) -> bool:
    """Tell whether a function, as it is written, gives the name that it is passed."""
    return _passes_on(path) or searches(path)


def _passes_on(path: str) -> bool:
    return is_resolver(last_name(path)) or path.endswith(tuple(_table()["tidying"]["paths"]))


def searches(path: str) -> bool:
    """Tell whether a function, as it is written, looks for a parameter in the namespaces above, too."""
    return path.endswith(tuple(_table()["searching"]["paths"]))


def leaves_arguments(path: str) -> bool:
    """Tell whether a function, as it is written, makes a name and leaves what it is given as it is."""
    reading = _table()["reading"]
    return _passes_on(path) or last_name(path) in reading["names"] or path.endswith(tuple(reading["paths"]))
