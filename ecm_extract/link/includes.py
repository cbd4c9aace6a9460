"""Which headers of the tree a source file sees."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ecm_extract.link.sight import Sight
    from ecm_extract.link.units import File


class Includes:
    """Follows includes through the files of a tree."""

    def __init__(self, files: tuple[File, ...], sight: Sight) -> None:
        self._sight = sight
        self._by_name: dict[str, list[File]] = defaultdict(list)
        self._reached: dict[int, dict[int, File]] = {}
        for file in files:
            self._by_name[PurePosixPath(file.path).name].append(file)

    def of(self, file: File) -> Mapping[int, File]:
        """Return the headers that a file sees by their identity, nearest first."""
        known = self._reached.get(id(file))
        if known is None:
            known = self._reached[id(file)] = {}
            pending = [file]
            for entry in pending:
                for header in self._direct(entry):
                    if id(header) not in known:
                        known[id(header)] = header
                        pending.append(header)
        return known

    def _direct(self, file: File) -> Iterator[File]:
        seen = self._sight.of(file.package)
        for entry in file.facts.imports:
            for other in self._by_name.get(entry.module.rpartition("/")[2], ()):
                if other.package in seen and other.path.endswith("/" + entry.module):
                    yield other
