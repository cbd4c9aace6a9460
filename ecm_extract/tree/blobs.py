"""Files known by path and git blob id alone, as a stored document has them; a repository holds their content."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from ecm_extract.errors import TreeReadError
from ecm_extract.tree.base import MAX_FILE_BYTES, Entry, printable
from ecm_extract.tree.git_batch import read_objects
from ecm_extract.tree.git_repo import GitRepo
from ecm_extract.tree.listing import ListedTree, Listing, too_large

_BLOB_ID: Final = re.compile(r"[0-9a-f]{40}|[0-9a-f]{64}")


class BlobTree(ListedTree):
    """The files of blobs; see `Tree` for its members.

    Args:
        repo: the repository.
        blobs: blob id by path; what is no id, as of a file that was in no commit, is left out.
        label: how the user named it.
        commit: that the files were read at; None of a work tree.
    """

    def __init__(self, repo: GitRepo, blobs: Mapping[str, str], *, label: str, commit: str | None) -> None:
        super().__init__(label, commit, repo.name)
        self._repo = repo
        self._blobs = {path: blob for path, blob in blobs.items() if _BLOB_ID.fullmatch(blob)}

    def read(self, path: str) -> bytes:
        """Content of one file; a process each, so prefer `read_many`."""
        return self._content(path, dict(read_objects(self._repo, [self._blob(path)])))

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given, out of one process; what is not there is left out."""
        wanted = [path for path in paths if path in self._blobs]
        contents = read_objects(self._repo, [self._blobs[path] for path in wanted])
        for path, found in zip(wanted, contents, strict=True):
            try:
                yield path, self._content(path, dict([found]))
            except TreeReadError as error:
                self._report_error(error)

    def _blob(self, path: str) -> str:
        self._entry(path)
        return self._blobs[path]

    def _content(self, path: str, found: Mapping[str, bytes | None]) -> bytes:
        data = found.get(self._blobs[path])
        if data is None:
            shown = printable(path)
            message = f"The content of {shown} is not in {self._repo.name}."
            raise TreeReadError(shown, "missing-blob", message, "Give the repository of the document with --repo.")
        if len(data) > MAX_FILE_BYTES:
            raise too_large(path, len(data))
        return data

    def _list(self) -> Listing:
        return Listing(tuple(Entry(path, identity=blob) for path, blob in self._blobs.items()), {})
