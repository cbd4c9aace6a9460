"""Names that need not be alike: the line that declared the old one stands there with the new one in its place.

`bumper` may become `bump` or `contact`: its publisher is the same variable, its subscriber has the same callback.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from ecm_extract.diff.model import Pair
from ecm_extract.diff.similarity import last_part
from ecm_extract.entities.endpoints import HOLE
from ecm_extract.entities.model import PublicEntity
from ecm_extract.tree import Tree

_KINDS: Final = frozenset({"topic", "service", "action", "parameter", "launch_argument"})
_SURE: Final = 0.85
_MAX_LINES: Final = 4
"""A call may go over several lines; its name stands in one of the first."""
_QUOTED: Final = r"(?<=[\"'/~]){}(?=[\"'])"
_REASON: Final = "the line that declares it is the same but for the name"


class Lines:
    """The lines of the files of a tree."""

    def __init__(self, tree: Tree) -> None:
        self._tree = tree
        self._files: dict[str, list[str]] = {}

    def at(self, path: str, line: int, count: int) -> list[str]:
        """Return lines without the white space around them; fewer at the end of the file."""
        if path not in self._files:
            data = dict(self._tree.read_many([path])).get(path, b"")
            self._files[path] = [text.strip() for text in data.decode("utf-8", "replace").splitlines()]
        return self._files[path][max(0, line - 1) : max(0, line - 1) + count]


class SameLine:
    """Both sides, to be asked which new name stands on the line of an old one.

    Attributes:
        files: new path of each file that moved.
    """

    def __init__(self, old: Tree, new: Tree, files: Mapping[str, str]) -> None:
        self._old, self._new, self._files = Lines(old), Lines(new), files

    def pairs(self, removed: Iterable[PublicEntity], added: Iterable[PublicEntity]) -> Iterator[Pair]:
        """Yield the pairs of a kind and type in one file that alone have each other's line."""
        fresh: dict[tuple[str, str, str | None, str], list[PublicEntity]] = defaultdict(list)
        for entity in added:
            if _is_literal(entity):
                fresh[entity.kind, entity.facet, entity.type, entity.path].append(entity)
        matches = []
        for old in filter(_is_literal, removed):
            place = old.kind, old.facet, old.type, self._files.get(old.path, old.path)
            matches += [(old, new) for new in fresh.get(place, ()) if self._is_same(old, new)]
        for old, new in matches:
            rivals = [pair for pair in matches if (pair[0] is old) != (pair[1] is new)]
            if not rivals:
                yield Pair(old, new, "renamed", _SURE, _REASON)

    def _is_same(self, old: PublicEntity, new: PublicEntity) -> bool:
        before = self._old.at(old.path, old.line, _MAX_LINES)
        after = self._new.at(new.path, new.line, _MAX_LINES)
        for count in range(1, min(len(before), len(after)) + 1):
            text, there = " ".join(before[:count]), " ".join(after[:count])
            replaced = _with_hole(text, old.name)
            if replaced != text:
                return replaced == _with_hole(there, new.name) and _tells(replaced)
        return False


def _is_literal(entity: PublicEntity) -> bool:
    return entity.kind in _KINDS and HOLE not in entity.name


def _with_hole(text: str, name: str) -> str:
    """A line without the name that it declares."""
    return re.sub(_QUOTED.format(re.escape(last_part(name))), HOLE, text)


def _tells(line: str) -> bool:
    """Whether a line holds more than a bare call: what it assigns, or what it hands on, tells it from its like."""
    return (
        re.search(r"[\w\]>)]\s*=[^=]|[&:]\w+::\w+|self\.\w+|\bbind\b|\[[&=\w, ]*\]\s*\(|\bthis->\w+", line) is not None
    )
