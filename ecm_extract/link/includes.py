"""Which headers of the tree a source file sees."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import PurePosixPath
from posixpath import dirname, join, normpath
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
                for header in self._direct(entry, file.include_folders):
                    if id(header) not in known:
                        known[id(header)] = header
                        pending.append(header)
        return known

    def _direct(self, file: File, folders: Sequence[str]) -> Iterator[File]:
        seen = self._sight.of(file.package)
        for entry in file.facts.imports:
            named = self._by_name.get(entry.module.rpartition("/")[2], ())
            fitting = [other for other in named if other.package in seen and _ends_with(other.path, entry.module)]
            yield from _as_a_preprocessor(entry.module, (dirname(file.path), *folders), fitting)


def _ends_with(path: str, module: str) -> bool:
    return path == module or path.endswith(f"/{module.removeprefix('../')}")


def _as_a_preprocessor(module: str, folders: Sequence[str], fitting: Sequence[File]) -> Sequence[File]:
    """Return the header that is in the first of the folders; all of its name where none of them has it.

    The first folder is that of the file that includes, the others are those of its target (cpp, "Search Path").
    """
    by_path = {other.path: other for other in fitting}
    places = (normpath(join(folder, module)) for folder in folders)
    found = next((by_path[place] for place in places if place in by_path), None)
    return fitting if found is None else (found,)
