"""Facts of source files by git blob id: a content that was seen once is not parsed again, wherever it lies."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Final

import msgspec

from ecm_extract.cache.folder import cache_folder
from ecm_extract.cache.store import Store
from ecm_extract.cache.version import FACTS, version_of
from ecm_extract.read.parsed_file import BlobFacts
from ecm_extract.read.select import SourceKind

Blob = tuple[SourceKind, str]
"""How a content is read, and its git blob id."""

_TIMED_OUT: Final = "-too-slow"
_UNENCODABLE: Final = (msgspec.MsgspecError, RecursionError, ValueError, OverflowError)


class BlobCache:
    """Facts of source files, kept from run to run.

    Args:
        store: where; None takes the user's.
    """

    def __init__(self, store: Store | None = None) -> None:
        self._store = store or Store(cache_folder())

    @cached_property
    def _version(self) -> str:
        return version_of(FACTS)

    def known(self, blobs: Iterable[Blob]) -> dict[Blob, BlobFacts]:
        """What is known of these contents."""
        keys = {self._key(blob): blob for blob in blobs} if self._version else {}
        decoder = msgspec.msgpack.Decoder(BlobFacts)
        found = {}
        for key, value in self._store.get(list(keys)).items():
            try:
                found[keys[key]] = decoder.decode(value)
            except (msgspec.MsgspecError, RecursionError):
                continue
        return found

    def add(self, found: Mapping[Blob, BlobFacts]) -> None:
        """Keep facts, except where a time limit cut them: another run may get further."""
        if not self._version:
            return
        values = {}
        encoder = msgspec.msgpack.Encoder()
        for blob, facts in found.items():
            try:
                if not is_timed_out(facts):
                    values[self._key(blob)] = encoder.encode(facts)
            except _UNENCODABLE:
                continue
        self._store.put(values)

    def _key(self, blob: Blob) -> str:
        return f"facts {self._version} {' '.join(blob)}"


def is_timed_out(facts: BlobFacts) -> bool:
    """Tell whether the parser gave up for want of time: the codes of its diagnostics say so."""
    return any(entry.code.endswith(_TIMED_OUT) for entry in facts.diagnostics)
