"""A tree that remembers which of its files were looked at, and what they held."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_extract.errors import TreeReadError
from ecm_extract.tree import Entry, FileDiagnostic, Tree, blob_id


class RecordedTree:
    """Another tree, with a record of what was read; see `Tree` for what its members mean.

    Attributes:
        blobs: git blob id of each file that was read, by path.
        stable: whether every file could be read and held the same each time.
    """

    def __init__(self, tree: Tree) -> None:
        self.label = tree.label
        self.commit = tree.commit
        self.repository = tree.repository
        self.folder, self.checkout = tree.folder, tree.checkout
        self.blobs: dict[str, str] = {}
        self.stable = True
        self._tree = tree
        self._entries: dict[str, Entry] | None = None

    @property
    def diagnostics(self) -> tuple[FileDiagnostic, ...]:
        """What could not be listed or read so far."""
        return self._tree.diagnostics

    def files(self) -> tuple[Entry, ...]:
        """All files, sorted by path."""
        return self._tree.files()

    def read(self, path: str) -> bytes:
        """Content of one file."""
        try:
            data = self._tree.read(path)
        except TreeReadError:
            self._lost(path)
            raise
        self._record(path, data)
        return data

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given."""
        wanted = list(paths)
        lost = set(wanted)
        for path, data in self._tree.read_many(wanted):
            lost.discard(path)
            self._record(path, data)
            yield path, data
        for path in lost:
            self._lost(path)

    def identity(self, path: str) -> str:
        """Git blob id of a file's content."""
        try:
            blob = self._tree.identity(path)
        except TreeReadError:
            self._lost(path)
            raise
        self.saw(path, blob)
        return blob

    def report(self, diagnostic: FileDiagnostic) -> None:
        """Add to `diagnostics`, once."""
        self._tree.report(diagnostic)

    def saw(self, path: str, blob: str) -> None:
        """Record what a file held; somebody may write it while it is read twice."""
        if self.blobs.setdefault(path, blob) != blob:
            self.stable = False

    def _record(self, path: str, data: bytes) -> None:
        entry = self._listed().get(path)
        self.saw(path, (entry.identity if entry is not None else None) or blob_id(data))

    def _lost(self, path: str) -> None:
        """Whether a file of a ref can be read stands in its listing; in a folder it may be another time."""
        entry = self._listed().get(path)
        if entry is not None and entry.identity is None:
            self.stable = False

    def _listed(self) -> dict[str, Entry]:
        if self._entries is None:
            self._entries = {entry.path: entry for entry in self._tree.files()}
        return self._entries
