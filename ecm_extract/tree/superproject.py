"""A ref with the submodules that it names, each at the commit that it names, where their objects are here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from pathlib import Path

from ecm_extract.errors import GitError, TreeError
from ecm_extract.tree.base import Entry, FileDiagnostic, Tree, printable
from ecm_extract.tree.git_batch import describe_objects, read_objects
from ecm_extract.tree.git_ref import GitTree
from ecm_extract.tree.git_repo import GitRepo
from ecm_extract.tree.joined import below, moved
from ecm_extract.tree.listing import MAX_FILES, too_many
from ecm_extract.tree.submodules import FILE_NAME, submodule_names, submodule_repo, submodule_unread

MAX_DEPTH = 8
"""Submodules within submodules that are followed; they can name each other in a circle."""


class SuperprojectTree:
    """A tree at a commit and, in the folders of its submodules, theirs; see `Tree` for what the members mean.

    Args:
        tree: at the commit, without submodules.
        repo: of the tree.
        folder: of the tree in the repository; empty for its root.
        depth: how many superprojects are around this one.
    """

    def __init__(self, tree: GitTree, repo: GitRepo, folder: str = "", depth: int = 0) -> None:
        self.label = tree.label
        self.commit: str | None = tree.commit
        self.repository = tree.repository
        self.folder = printable(folder.rpartition("/")[2]) or repo.name
        self.checkout: Path | None = None
        self._tree, self._repo, self._folder, self._depth = tree, repo, folder, depth
        self._parts: dict[str, Tree] | None = None
        self._entries: tuple[Entry, ...] = ()

    @property
    def diagnostics(self) -> tuple[FileDiagnostic, ...]:
        """What could not be listed or read so far: of the tree, then of each submodule."""
        parts = (self._parts or {}).items()
        return *self._tree.diagnostics, *(moved(path, entry) for path, part in parts for entry in part.diagnostics)

    def files(self) -> tuple[Entry, ...]:
        """All files, sorted by path."""
        if self._parts is None:
            self._parts = dict(self._open())
            mounted = [below(path, entry) for path, part in self._parts.items() for entry in part.files()]
            self._entries = tuple(sorted((*self._tree.files(), *mounted), key=lambda entry: entry.path))
        if len(self._entries) > MAX_FILES:
            raise too_many(self.label)
        return self._entries

    def read(self, path: str) -> bytes:
        """Content of one file."""
        part = self._part(path)
        return self._of(part).read(_inside(part, path))

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given; neighbours of one tree are read together."""
        for part, group in groupby(paths, self._part):
            for path, data in self._of(part).read_many([_inside(part, path) for path in group]):
                yield f"{part}/{path}" if part else path, data

    def identity(self, path: str) -> str:
        """Git blob id of a file's content."""
        part = self._part(path)
        return self._of(part).identity(_inside(part, path))

    def report(self, diagnostic: FileDiagnostic) -> None:
        """Add to `diagnostics`, once."""
        self._tree.report(diagnostic)

    def _part(self, path: str) -> str:
        """Path of the submodule that holds a file; empty for the tree itself."""
        self.files()
        return next((part for part in self._parts or () if path.startswith(f"{part}/")), "")

    def _of(self, part: str) -> Tree:
        return (self._parts or {})[part] if part else self._tree

    def _open(self) -> Iterator[tuple[str, Tree]]:
        """Each submodule that can be listed, by its path; the others are reported."""
        names = self._names() if self._tree.submodules else {}
        for path, commit in self._tree.submodules.items():
            part = self._opened(path, commit, names)
            if part is None:
                self.report(submodule_unread(path, commit))
            else:
                yield path, part

    def _names(self) -> Mapping[str, str]:
        for _, data in read_objects(self._repo, [f"{self.commit}:{FILE_NAME}"]):
            return submodule_names(data or b"")
        return {}

    def _opened(self, path: str, commit: str, names: Mapping[str, str]) -> Tree | None:
        place = f"{self._folder}/{path}" if self._folder else path
        repo = submodule_repo(self._repo, place, names.get(place)) if self._depth < MAX_DEPTH else None
        if repo is None:
            return None
        try:
            found = describe_objects(repo, [f"{commit}^{{tree}}"])[0]
            if found is None:
                return None
            tree = GitTree(repo, found[0], label=self.label, commit=commit, repository=self.repository)
            part = SuperprojectTree(tree, repo, depth=self._depth + 1)
            part.files()
        except (TreeError, GitError):
            return None
        return part


def _inside(part: str, path: str) -> str:
    return path.removeprefix(f"{part}/") if part else path
