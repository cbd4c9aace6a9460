"""Names that objects of libraries bring to a process, as far as a table tells of these."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

import msgspec
from ecm_parsers.source.facts import SourceFile

from ecm_extract.shipped import shipped_as


class LibraryObject(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A row of the table; its head says what each column means."""

    source: str
    taken: tuple[str, ...]
    brings: frozenset[str]


class LibraryObjects(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole table."""

    library: tuple[LibraryObject, ...]


@cache
def library_objects() -> LibraryObjects:
    """Return the table."""
    return shipped_as("lint/library_objects.toml", LibraryObjects)


def brought_by_objects(sources: Iterable[SourceFile]) -> frozenset[str]:
    """Return the names that objects of libraries may bring which some source of a package takes in."""
    taken = {entry.module for source in sources for entry in source.imports}
    rows = (row for row in library_objects().library if any(module.startswith(row.taken) for module in taken))
    return frozenset(name for row in rows for name in row.brings)
