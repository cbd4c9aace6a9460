"""Documents of packages as content: canonical JSON, named by its hash, compressed.

Where a package was read (repository, commit) stands with the release and not in the content, so that a package that
did not change between two commits is one content.
"""

from __future__ import annotations

import hashlib
from typing import Any, Final

import msgspec
import zstandard
from ecm_checker.hub.package import Package

from ecm_extract.errors import ToolError

_LEVEL: Final = 6
MAX_BYTES: Final = 500_000_000
"""Largest content that is unpacked."""


class Packed(msgspec.Struct, frozen=True):
    """A document: `digest` of its canonical JSON, which is `size` bytes long and compressed in `data`."""

    digest: str
    data: bytes
    size: int


def pack(package: Package) -> Packed:
    """Return a package as content."""
    plain = msgspec.to_builtins(package)
    for module in plain.get("modules", ()):
        module["ecm"]["source"] = {**module["ecm"]["source"], "repository": None, "commit": None}
    canonical = msgspec.json.encode(_lists_of(plain), order="deterministic")
    return Packed(hashlib.sha256(canonical).hexdigest(), compress(canonical), len(canonical))


def _lists_of(plain: dict[str, Any]) -> dict[str, Any]:
    """What is written of a package and nothing of the tree that it lay in."""
    return {key: value for key, value in plain.items() if key not in {"schema", "source"}}


def unpack(data: bytes, digest: str, repository: str | None, commit: str | None) -> Package:
    """Return the package of a content, with where it was read.

    Raises:
        ToolError: the content is damaged.
    """
    canonical = decompress(data, digest)
    if hashlib.sha256(canonical).hexdigest() != digest:
        message = f"the content {digest[:12]} is damaged"
        raise ToolError(message, "restore the registry from a copy; `ecm-extract registry verify` tells what is wrong")
    package = msgspec.json.decode(canonical, type=Package)
    modules = tuple(
        msgspec.structs.replace(
            each,
            ecm=msgspec.structs.replace(
                each.ecm,
                source=msgspec.structs.replace(each.ecm.source, repository=repository, commit=commit),
            ),
        )
        for each in package.modules
    )
    return msgspec.structs.replace(package, modules=modules)


def compress(data: bytes) -> bytes:
    """Return data compressed."""
    return zstandard.ZstdCompressor(level=_LEVEL).compress(data)


def decompress(data: bytes, name: str) -> bytes:
    """Return data as it was.

    Raises:
        ToolError: it is damaged; `name` tells which.
    """
    try:
        return zstandard.ZstdDecompressor().decompress(data, max_output_size=MAX_BYTES)
    except zstandard.ZstdError as error:
        message = f"{name[:12]} cannot be unpacked: {error}"
        raise ToolError(message, "restore the registry from a copy") from error
