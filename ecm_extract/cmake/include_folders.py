"""Folders in which the sources of a target look for headers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

import msgspec

from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.genex import has_genex

_WORDS: Final = frozenset({"PUBLIC", "PRIVATE", "INTERFACE", "SYSTEM", "BEFORE", "AFTER"})
_BUILD: Final = "$<BUILD_INTERFACE:"


def include_folders(texts: Sequence[str], call: Call, path: str) -> Iterator[str]:
    """Yield folders of the tree that a call names, from the folder of a file.

    Args:
        texts: arguments after the target.
        call: that names them.
        path: of the file that the folders are told to.
    """
    place = msgspec.structs.replace(call, path=path)
    for text in texts:
        # `$<BUILD_INTERFACE:a;b>` is split at its semicolon.
        folder = text.removeprefix(_BUILD).removesuffix(">")
        if folder and text not in _WORDS and not has_genex(folder):
            yield place.file(folder)
