"""The freeze: a content hash over everything that decides a verdict, and the hash that is pinned.

A verdict counts only when the checker that gave it is the pinned one.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from functools import cache
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Final

import msgspec

PINNED_FILE: Final = "FROZEN"

# These write and publish what was decided; none of them decides.
_NOT_DECIDING: Final = frozenset({"encode.py", "json_data.py", "json_schema.py", "wire.py", "schema", PINNED_FILE})
_SOURCES: Final = (".py", ".toml")


class Frozen(msgspec.Struct, frozen=True):
    """The hash of this checker and the pinned one (empty when nothing is pinned)."""

    current: str
    pinned: str

    @property
    def holds(self) -> bool:
        """Whether this checker is the pinned one."""
        return self.current == self.pinned


@cache
def content_hash() -> str:
    """SHA-256 over names and contents of rules, operations, data and model, in hexadecimal."""
    digest = hashlib.sha256()
    for name, file in sorted(_sources(resources.files("ecm_checker"), "")):
        content = file.read_bytes().replace(b"\r\n", b"\n")
        digest.update(f"{name}\0{len(content)}\0".encode())
        digest.update(content)
    return digest.hexdigest()


def verify() -> Frozen:
    """Compare the hash of this checker with the pinned one."""
    file = resources.files("ecm_checker") / PINNED_FILE
    return Frozen(content_hash(), file.read_text("utf-8").strip() if file.is_file() else "")


def _sources(folder: Traversable, prefix: str) -> Iterator[tuple[str, Traversable]]:
    for entry in folder.iterdir():
        name = f"{prefix}{entry.name}"
        if name in _NOT_DECIDING:
            continue
        if entry.is_dir():
            yield from _sources(entry, f"{name}/")
        elif name.endswith(_SOURCES):
            yield name, entry
