"""What people wrote about changes in changelogs and migration notes, as sentences."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from ecm_extract.tree import Tree

_CHANGELOG: Final = re.compile(r"(?:^|/)(?:CHANGELOG|changelog|migration)[\w.-]*\.(?:rst|md)$")
_SHORTEST: Final = 9
MAX_BYTES: Final = 4_000_000


def is_note(path: str) -> bool:
    """Tell whether a file is a changelog or migration notes."""
    return _CHANGELOG.search(path) is not None


def read_notes(tree: Tree, paths: Iterable[str]) -> Mapping[str, Sequence[str]]:
    """Return the sentences of the notes among some files of a tree, by path."""
    return {path: sentences(data) for path, data in tree.read_many([path for path in paths if is_note(path)])}


def sentences(data: bytes) -> list[str]:
    """Return the lines of a text that are long enough to say something."""
    lines = (line.strip(" \t*-") for line in data[:MAX_BYTES].decode("utf-8", "replace").splitlines())
    return [line for line in lines if len(line) >= _SHORTEST]


def no_notes(paths: Iterable[str]) -> Mapping[str, Sequence[str]]:
    """Return the notes of a side that has none."""
    return {}
