"""The small declarative files of a ref in one go: a git process for each would cost more than parsing it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from ecm_extract.tree import Entry, Tree

MAX_FILE_BYTES: Final = 256_000
MAX_BYTES: Final = 64_000_000

_DECLARATIVE: Final = (
    *(".msg", ".srv", ".action", ".xml", ".yaml", ".yml", ".cfg"),
    *("CMakeLists.txt", ".cmake", "setup.py", "setup.cfg", "pyproject.toml"),
)


class Prefetch:
    """Contents of a tree's files, read ahead where that is cheaper, until they are dropped."""

    def __init__(self, tree: Tree) -> None:
        self._tree = tree
        self._contents: dict[str, bytes] = {}

    def fetch(self, entries: Iterable[Entry]) -> None:
        """Read ahead those files that are of a ref, declarative and small."""
        left = MAX_BYTES
        paths = []
        for entry in entries:
            if entry.identity is not None and entry.path.endswith(_DECLARATIVE) and _is_small(entry, left):
                paths.append(entry.path)
                left -= entry.size or 0
        self._contents = dict(self._tree.read_many(paths))

    def drop(self) -> None:
        """Forget what was read ahead."""
        self._contents = {}

    def read(self, path: str) -> bytes | None:
        """Content of one file; None when it cannot be read, which the tree's diagnostics then say."""
        data = self._contents.get(path)
        if data is not None:
            return data
        return next((data for _, data in self._tree.read_many([path])), None)


def _is_small(entry: Entry, left: int) -> bool:
    return entry.size is not None and entry.size <= min(MAX_FILE_BYTES, left)
