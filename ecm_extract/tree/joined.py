"""Several trees as one workspace, each in a folder of its own: repositories that are built together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import msgspec

from ecm_extract.errors import TreeReadError
from ecm_extract.tree.base import Entry, FileDiagnostic, Tree


class JoinedTree:
    """Trees by the name of their folder; see `Tree` for what the members mean.

    A workspace of several repositories is at no single commit.
    """

    def __init__(self, trees: Mapping[str, Tree]) -> None:
        self.label = "+".join(tree.label for tree in trees.values())
        self.commit: str | None = None
        self.repository: str | None = None
        self.folder = ""
        self.checkout: Path | None = None
        self._trees = dict(trees)
        self._own: dict[FileDiagnostic, None] = {}
        self._files: tuple[Entry, ...] | None = None

    @property
    def diagnostics(self) -> tuple[FileDiagnostic, ...]:
        """What could not be listed or read so far, tree by tree, then what was reported of the whole."""
        below = [moved(name, entry) for name, tree in self._trees.items() for entry in tree.diagnostics]
        return *below, *self._own

    def files(self) -> tuple[Entry, ...]:
        """All files, sorted by path."""
        if self._files is None:
            found = [below(name, entry) for name, tree in self._trees.items() for entry in tree.files()]
            self._files = tuple(sorted(found, key=lambda entry: entry.path))
        return self._files

    def read(self, path: str) -> bytes:
        """Content of one file."""
        tree, inner = self._inside(path)
        return tree.read(inner)

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given; neighbours of one tree are read together."""
        for name, group in _runs(paths):
            tree = self._trees.get(name)
            if tree is not None:
                yield from ((f"{name}/{inner}", data) for inner, data in tree.read_many(group))

    def identity(self, path: str) -> str:
        """Git blob id of a file's content."""
        tree, inner = self._inside(path)
        return tree.identity(inner)

    def report(self, diagnostic: FileDiagnostic) -> None:
        """Add to `diagnostics`, once."""
        self._own.setdefault(diagnostic)

    def _inside(self, path: str) -> tuple[Tree, str]:
        name, _, inner = path.partition("/")
        tree = self._trees.get(name)
        if tree is None:
            message = f"{path} is in none of the trees of the workspace."
            raise TreeReadError(path, "not-in-tree", message)
        return tree, inner


def below(name: str, entry: Entry) -> Entry:
    """A file of a tree that stands in the folder `name` of another."""
    target = f"{name}/{entry.target}" if entry.target is not None else None
    return msgspec.structs.replace(entry, path=f"{name}/{entry.path}", target=target)


def moved(name: str, diagnostic: FileDiagnostic) -> FileDiagnostic:
    """A diagnostic of a tree that stands in the folder `name` of another."""
    path = f"{name}/{diagnostic.path}" if diagnostic.path else name
    unread = diagnostic.unread and msgspec.structs.replace(diagnostic.unread, path=f"{name}/{diagnostic.unread.path}")
    return msgspec.structs.replace(diagnostic, path=path, unread=unread)


def _runs(paths: Iterable[str]) -> Iterator[tuple[str, list[str]]]:
    """Paths without their first folder, in runs of the same first folder."""
    current, group = "", list[str]()
    for path in paths:
        name, _, inner = path.partition("/")
        if name != current and group:
            yield current, group
            group = []
        current = name
        group.append(inner)
    if group:
        yield current, group
