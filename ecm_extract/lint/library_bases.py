"""Which names the base classes of a class bring that other repositories have, as far as a table tells of these."""

from __future__ import annotations

import builtins
import sys
from collections.abc import Iterable
from functools import cache

import msgspec

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.program import Program
from ecm_extract.shipped import shipped_as


class LibraryBase(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A row of the table; its head says what each column means."""

    source: str
    names: frozenset[str] = frozenset()
    inside: tuple[str, ...] = ()
    brings: frozenset[str] = frozenset()


class LibraryBases(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole table."""

    library: tuple[LibraryBase, ...]


@cache
def library_bases() -> LibraryBases:
    """Return the table."""
    return shipped_as("lint/library_bases.toml", LibraryBases)


def brought_by_bases(cls: Cls, program: Program) -> frozenset[str] | None:
    """Return the names that bases outside of the tree bring, at any distance; None where one of them is not known."""
    found: frozenset[str] = frozenset()
    for entry in program.ancestry(cls):
        for written in entry.fact.bases:
            if program.class_named(plain(written), entry.file, entry.fact.scope) is None:
                brought = _brought(written, entry, program)
                if brought is None:
                    return None
                found |= brought
    return found


def _brought(written: str, cls: Cls, program: Program) -> frozenset[str] | None:
    """The names that a base of a class brings which the tree lacks, or has several of."""
    if plain(written) in cls.fact.template:
        return None
    names = program.readings(written, cls.file, cls.fact.scope)
    if cls.file.language == "python" and any(map(_is_of_python, names)):
        return frozenset()
    return next((row.brings for row in library_bases().library if _is_of(names, row)), None)


def _is_of(names: Iterable[str], row: LibraryBase) -> bool:
    return any(name in row.names or name.startswith(row.inside) for name in names)


def _is_of_python(name: str) -> bool:
    """Whether a class is one of the language itself, or of its library."""
    module, dot, _ = name.partition(".")
    return module in sys.stdlib_module_names if dot else hasattr(builtins, name)
