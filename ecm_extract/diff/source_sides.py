"""Sides and consumers that are read off sources; what only stored documents compare does without."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from ecm_checker.match.consumer import Consumer
from ecm_parsers.source.facts import SourceFile

from ecm_extract.asked import refuse_empty
from ecm_extract.diff.sides import NewSide
from ecm_extract.entities.notes import no_notes, read_notes
from ecm_extract.entities.side import Side
from ecm_extract.entities.workspace import PackagesRead, Workspace, link_packages, read_packages, side_of
from ecm_extract.extraction_model import Options
from ecm_extract.parallel_work import jobs_for, meanwhile
from ecm_extract.read.facts import function_count
from ecm_extract.requires.collect import consumers
from ecm_extract.tree import FileDiagnostic, Tree


def source_side_before(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> Callable[[], Side]:
    """Begin to link the old side in another process, and return the function that waits for it."""
    read = _read(tree, options, parsed)
    told = frozenset(tree.diagnostics)
    jobs = jobs_for(function_count(read.packages), options.jobs)
    linked = meanwhile(lambda: _linked(read, told), jobs)
    return lambda: _reported(linked(), tree)


def source_side_after(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> NewSide:
    """Read and link the new side."""
    workspace = _linked_tree(tree, options, parsed)
    return NewSide(side_of(workspace), lambda: consumers(workspace))


def source_consumers(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> list[Consumer]:
    """Read and link the packages of a consumer."""
    return consumers(_linked_tree(tree, options, parsed))


def _linked_tree(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> Workspace:
    return link_packages(_read(tree, options, parsed))


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
