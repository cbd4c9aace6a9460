"""The files that a comparison knows of a tree, whether it reads the sources or stored documents of its packages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ecm_extract.answers.accepted_file import FILE_NAME
from ecm_extract.entities.notes import is_note
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.launches_outside import launches_outside
from ecm_extract.tree import Entry, Tree


def listed(tree: Tree, packages: Iterable[PackageFacts]) -> Sequence[Entry]:
    """Return the files of packages and those that concern all of them, sorted by path."""
    entries = {entry.path: entry for facts in packages for entry in facts.root.files}
    entries |= {entry.path: entry for entry in shared_files(tree, entries)}
    return [entries[path] for path in sorted(entries)]


def shared_files(tree: Tree, owned: Iterable[str]) -> Sequence[Entry]:
    """Return what lies outside of packages and concerns all of them: changelogs, what was accepted, launch files.

    Args:
        tree: that holds the packages.
        owned: paths of the files of packages.
    """
    inside = frozenset(owned)
    launches = {entry.path for entry in launches_outside(tree.files(), inside)}
    outside = (entry for entry in tree.files() if entry.path not in inside)
    return [entry for entry in outside if entry.path in launches or _concerns_all(entry.path)]


def _concerns_all(path: str) -> bool:
    return path == FILE_NAME or is_note(path)
