"""The two sides of a comparison, read one after the other so that no blob is parsed twice, linked side by side."""

from __future__ import annotations

from collections.abc import Callable

import msgspec
from ecm_checker.match.consumer import Consumer
from ecm_parsers.source.facts import SourceFile

from ecm_extract.entities.side import Side
from ecm_extract.extraction_model import Options
from ecm_extract.stored import Stored, stored_consumers, stored_side
from ecm_extract.tree import Tree


class Sides(msgspec.Struct, frozen=True):
    """Both sides down to their entities.

    Attributes:
        own: gives the packages of the new side as consumers, which they are as well.
    """

    old: Side
    new: Side
    own: Callable[[], list[Consumer]]


class NewSide(msgspec.Struct, frozen=True):
    """The new side, and what gives its packages as consumers."""

    side: Side
    own: Callable[[], list[Consumer]]


def both_sides(old: Tree | Stored, new: Tree | Stored, options: Options, parsed: dict[str, SourceFile]) -> Sides:
    """Read both sides; stored documents and sources may stand against each other.

    Args:
        old: the tree before.
        new: the tree after.
        options: of the extraction; with one job nothing is forked.
        parsed: facts by blob id, to take from and to add to.

    Raises:
        NothingThereError: a side holds no package.
    """
    if not isinstance(old, Stored) and not isinstance(new, Stored):
        old.folder = new.folder  # two states of one folder, wherever they lie
    before = _before(old, options, parsed)
    after = _after(new, options, parsed)
    return Sides(before(), after.side, after.own)


def consumers_of(other: Tree | Stored, options: Options, parsed: dict[str, SourceFile]) -> list[Consumer]:
    """Return the packages of a tree or of documents as consumers.

    Raises:
        NothingThereError: a tree holds no package.
    """
    if isinstance(other, Stored):
        return stored_consumers(other)
    from ecm_extract.diff.source_sides import source_consumers

    return source_consumers(other, options, parsed)


def _before(old: Tree | Stored, options: Options, parsed: dict[str, SourceFile]) -> Callable[[], Side]:
    if isinstance(old, Stored):
        return lambda: stored_side(old)
    # Reading sources takes parsers and the linker, whose import takes longer than comparing two documents.
    from ecm_extract.diff.source_sides import source_side_before

    return source_side_before(old, options, parsed)


def _after(new: Tree | Stored, options: Options, parsed: dict[str, SourceFile]) -> NewSide:
    if isinstance(new, Stored):
        return NewSide(stored_side(new), lambda: stored_consumers(new))
    from ecm_extract.diff.source_sides import source_side_after

    return source_side_after(new, options, parsed)
