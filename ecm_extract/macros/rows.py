"""What is known of macros in headers of packages that are not in the tree: rows, bundled and of the user."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec
from ecm_parsers.source.cpp_macro_definitions import replacement
from ecm_parsers.source.facts import Replacement

from ecm_extract.shipped import shipped_as


class HeaderRow(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a header defines for those that include it.

    Attributes:
        path: as it is included, `package/name.hpp`.
        defines: `NAME(parameters) what it stands for`, as behind `#define`, in one line each.
    """

    path: str
    defines: tuple[str, ...]

    def __post_init__(self) -> None:
        """Refuse what is no definition, so that it is an error and not a row without effect."""
        for each in self.defines:
            if not each[:1].isidentifier() or replacement(each.encode()) is None:
                message = f"`{each}` is no definition of a macro; write `NAME(a, b) what it stands for`"
                raise ValueError(message)

    def macros(self) -> tuple[Replacement, ...]:
        """Return its macros."""
        found = (replacement(each.encode()) for each in self.defines)
        return tuple([each for each in found if each is not None])


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    header: tuple[HeaderRow, ...]


def macros_of_headers(extra: Iterable[HeaderRow] = ()) -> Mapping[str, tuple[Replacement, ...]]:
    """Return the macros of known headers by their paths, the user's rows before the bundled ones."""
    rows = (*shipped_as("macros/rows.toml", _Table).header, *extra)
    return {row.path: row.macros() for row in rows}
