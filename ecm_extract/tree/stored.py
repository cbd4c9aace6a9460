"""The files of stored packages: all are listed, and those are read whose content the documents keep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from ecm_extract.errors import TreeReadError
from ecm_extract.tree.base import Entry, printable
from ecm_extract.tree.listing import ListedTree, Listing

NOT_KEPT: Final = "launch-text-not-kept"
"""Code of what is said of a file whose content no document keeps."""


class StoredTree(ListedTree):
    """Files known by their documents; see `Tree` for its members.

    Args:
        label, commit, repository: of the tree that was read.
        paths: of all files.
        texts: contents by path.
    """

    def __init__(
        self, label: str, commit: str | None, repository: str | None, paths: frozenset[str], texts: Mapping[str, str]
    ) -> None:
        super().__init__(label, commit, repository)
        self._paths, self._texts = paths, texts

    def read(self, path: str) -> bytes:
        """Content of one file."""
        self._entry(path)
        text = self._texts.get(path)
        if text is None:
            shown = printable(path)
            message = f"The document of its package keeps no content of {shown}."
            raise TreeReadError(shown, NOT_KEPT, message, "Name the sources with --workspace instead.")
        return text.encode("utf-8")

    def _list(self) -> Listing:
        return Listing(tuple(Entry(path) for path in self._paths), {})
