"""The two sides of a comparison, read one after the other so that no blob is parsed twice, linked side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ecm_parsers.source.facts import SourceFile

from ecm_extract.asked import refuse_empty
from ecm_extract.diff.background import meanwhile
from ecm_extract.entities.side import PackagesRead, Side, Workspace, link_packages, read_packages, side_of
from ecm_extract.extraction_model import Options
from ecm_extract.tree import FileDiagnostic, Tree


class Sides(NamedTuple):
    """Both sides down to their entities, and the new one linked, which uses are read off; None for manifests."""

    old: Side
    new: Side
    workspace: Workspace | None


def both_sides(old: Tree, new: Tree, options: Options, parsed: dict[str, SourceFile]) -> Sides:
    """Read both sides.

    Args:
        old: the tree before.
        new: the tree after.
        options: of the extraction; with one job nothing is forked.
        parsed: facts by blob id, to take from and to add to.

    Raises:
        NothingThereError: a side holds no package.
    """
    before = _read(old, options, parsed)
    told = frozenset(old.diagnostics)
    linked = meanwhile(lambda: _linked(before, told), options.jobs)
    workspace = link_packages(_read(new, options, parsed))
    after = side_of(workspace)
    return Sides(_reported(linked(), old), after, workspace)


def _read(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> PackagesRead:
    read = read_packages(tree, options, parsed)
    refuse_empty(tree, [package.root for package in read.packages])
    return read


def _linked(before: PackagesRead, told: frozenset[FileDiagnostic]) -> tuple[Side, Sequence[FileDiagnostic]]:
    """In a fork what linking reports would be lost with it."""
    side = side_of(link_packages(before))
    return side, [entry for entry in before.tree.diagnostics if entry not in told]


def _reported(result: tuple[Side, Sequence[FileDiagnostic]], tree: Tree) -> Side:
    side, diagnostics = result
    for diagnostic in diagnostics:
        tree.report(diagnostic)
    side.tree = tree
    return side
