"""Sources that targets are made of and that lie in the folder of no package, and the headers included from there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from posixpath import dirname, join, normpath

from ecm_extract.cmake.sources import paths_of
from ecm_extract.exclusion import Exclusion
from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.parsed_file import Task
from ecm_extract.read.select import source_kind
from ecm_extract.tree import Entry


class SharedSources:
    """Tells what packages take from beside them.

    Args:
        packages: of the tree.
        entries: of the tree.
        exclude: what is not read.
    """

    def __init__(self, packages: Sequence[PackageFacts], entries: Iterable[Entry], exclude: Exclusion) -> None:
        owned = {entry.path for package in packages for entry in package.root.files}
        beside = (entry for entry in entries if entry.path not in owned and source_kind(entry, "") == "cpp")
        self._beside = frozenset(entry.path for entry in beside if not exclude.leaves_out(entry.path))

    def wanted(self, package: PackageFacts) -> list[Task]:
        """Return what a package takes and has not yet: what its targets compile, then what its sources include."""
        found = [path for path in (*self._compiled(package), *self._included(package)) if path in self._beside]
        return [(path, "cpp") for path in dict.fromkeys(found) if path not in package.sources]

    def _compiled(self, package: PackageFacts) -> Iterator[str]:
        for path, file in package.cmake.items() if self._beside else ():
            for target in file.targets:
                yield from () if target.is_test else paths_of(target, path)

    def _included(self, package: PackageFacts) -> Iterator[str]:
        """What is included in quotes or in brackets, in the folder of a file or in one that targets name."""
        folders = [
            folder for folder in _folders(package) if any(path.startswith(f"{folder}/") for path in self._beside)
        ]
        beside = {path for path in package.sources if path in self._beside}
        for path, facts in package.sources.items() if folders or beside else ():
            for entry in facts.imports if facts.language == "cpp" else ():
                yield from (normpath(join(folder, entry.module)) for folder in (dirname(path), *folders))


def _folders(package: PackageFacts) -> Iterator[str]:
    named = (
        normpath(join(dirname(path), each))
        for path, file in package.cmake.items()
        for target in file.targets
        for each in target.include_folders
        if "$" not in each
    )
    return iter(dict.fromkeys(named))
