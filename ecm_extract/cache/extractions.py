"""Whole extractions: a tree of which no file that was read has changed is not read again.

An extraction is a function of the listing of a tree, of the files that it reads, of its options and of the program.
What it reads is decided by what it has read before, so it is enough that the listing and the content of all files of
that record are the same. The record of the newest extraction is kept by the listing, the extraction by both.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Final

import msgspec

from ecm_extract.cache.folder import cache_folder
from ecm_extract.cache.store import Store
from ecm_extract.cache.version import EXTRACTION, version_of
from ecm_extract.errors import TreeReadError
from ecm_extract.extraction_model import Extraction, Options
from ecm_extract.tree import Tree

_UNREPEATABLE: Final = ("-too-slow", "worker-lost")
"""Ends of the codes of diagnostics that another run may not have."""

_UNENCODABLE: Final = (msgspec.MsgspecError, RecursionError, ValueError, OverflowError, TypeError)


class ExtractionCache:
    """Extractions of one tree under one set of options, kept from run to run.

    Args:
        tree: that is extracted.
        options: of the extraction.
        store: where; None takes the user's.

    Raises:
        TreeError: the tree cannot be listed.
    """

    def __init__(self, tree: Tree, options: Options, store: Store | None = None) -> None:
        self._tree = tree
        self._options = options
        self._store = store or Store(cache_folder())

    @cached_property
    def _listing(self) -> str:
        """Hash of what is known before any file is read; empty when nothing can be kept."""
        version = version_of(EXTRACTION)
        config = _config(self._options)
        if not version or config is None:
            return ""
        entries = self._tree.files()
        about = (
            self._tree.label,
            self._tree.commit,
            self._tree.repository,
            self._tree.folder,
            self._options.include_tests,
            self._options.hub,
            config,
        )
        lines = [repr((version, about))]
        lines += [f"{e.path}\0{e.size}\0{e.identity}\0{e.target}\0{e.executable}" for e in entries]
        lines += [repr(entry) for entry in self._tree.diagnostics]
        return _hash(lines)

    def known(self) -> Extraction | None:
        """The extraction that reading the tree would give; None when it must be read."""
        record = f"reads {self._listing}"
        value = self._store.get([record]).get(record) if self._listing else None
        if value is None:
            return None
        try:
            paths = value.decode("utf-8", "surrogateescape").split("\0")
            key = self._key({path: self._tree.identity(path) for path in paths})
            found = self._store.get([key]).get(key)
            return None if found is None else msgspec.msgpack.decode(found, type=Extraction)
        except (TreeReadError, msgspec.MsgspecError, RecursionError):
            return None

    def add(self, extraction: Extraction, blobs: Mapping[str, str]) -> None:
        """Keep an extraction, unless a time limit cut it.

        Args:
            extraction: of the tree, under the options.
            blobs: git blob id of each file that was read for it, by path.
        """
        if not self._listing or any(entry.code.endswith(_UNREPEATABLE) for entry in extraction.diagnostics):
            return
        read = "\0".join(sorted(blobs)).encode("utf-8", "surrogateescape")
        try:
            value = msgspec.msgpack.encode(extraction)
        except _UNENCODABLE:
            return
        self._store.put({f"reads {self._listing}": read, self._key(blobs): value})

    def _key(self, blobs: Mapping[str, str]) -> str:
        lines = [self._listing, *(f"{path}\0{blobs[path]}" for path in sorted(blobs))]
        return f"extraction {_hash(lines)}"


def _config(options: Options) -> bytes | None:
    """Content of the configuration that was named; None when it cannot be read, which the extraction will say."""
    try:
        return b"" if options.config is None else options.config.encode() + b"\0" + Path(options.config).read_bytes()
    except (OSError, ValueError):
        return None


def _hash(lines: Iterable[str]) -> str:
    data = "\n".join(lines).encode("utf-8", "surrogateescape")
    return hashlib.sha256(data).hexdigest()
