"""The two sides of a comparison, read one after the other so that no blob is parsed twice, linked side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import msgspec
from ecm_checker.match.consumer import Consumer
from ecm_parsers.source.facts import SourceFile

from ecm_extract.asked import refuse_empty
from ecm_extract.entities.notes import no_notes, read_notes
from ecm_extract.entities.side import PackagesRead, Side, link_packages, read_packages, side_of
from ecm_extract.extraction_model import Options
from ecm_extract.parallel_work import meanwhile
from ecm_extract.requires.collect import consumers
from ecm_extract.stored import Stored, stored_consumers, stored_side
from ecm_extract.tree import FileDiagnostic, Tree


class Sides(msgspec.Struct, frozen=True):
    """Both sides down to their entities.

    Attributes:
        own: gives the packages of the new side as consumers, which they are as well.
    """

    old: Side
    new: Side
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
    before = _side_before(old, options, parsed)
    if isinstance(new, Stored):
        return Sides(before(), stored_side(new), lambda: stored_consumers(new))
    workspace = link_packages(_read(new, options, parsed))
    after = side_of(workspace)
    return Sides(before(), after, lambda: consumers(workspace))


def _side_before(old: Tree | Stored, options: Options, parsed: dict[str, SourceFile]) -> Callable[[], Side]:
    """Begin to link the old side in another process, and return the function that waits for it."""
    if isinstance(old, Stored):
        return lambda: stored_side(old)
    read = _read(old, options, parsed)
    told = frozenset(old.diagnostics)
    linked = meanwhile(lambda: _linked(read, told), options.jobs)
    return lambda: _reported(linked(), old)


def _read(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> PackagesRead:
    read = read_packages(tree, options, parsed)
    refuse_empty(tree, [package.root for package in read.packages])
    return read


def _linked(before: PackagesRead, told: frozenset[FileDiagnostic]) -> tuple[Side, Sequence[FileDiagnostic]]:
    """In a fork what linking reports would be lost with it."""
    side = side_of(link_packages(before))
    side.notes = no_notes  # a tree, which reads them, does not leave its process
    return side, [entry for entry in before.tree.diagnostics if entry not in told]


def _reported(result: tuple[Side, Sequence[FileDiagnostic]], tree: Tree) -> Side:
    side, diagnostics = result
    for diagnostic in diagnostics:
        tree.report(diagnostic)
    side.notes = partial(read_notes, tree)
    return side
