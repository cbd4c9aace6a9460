"""Which headers of the tree a C++ file includes, found as a preprocessor finds them.

Source: cpp, "Search Path": the folder of the file that includes, for `"..."` only, then the include folders of the
target. What these do not have is looked for where packages export headers, then by the end of its path, as the folders
of a build are not always known; there it counts only if it is the only one.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from posixpath import basename, dirname

from ecm_parsers.source.facts import Import

from ecm_extract.link.code.units import File
from ecm_extract.resolve.layout import PackageLayout
from ecm_extract.resolve.paths import tree_path
from ecm_extract.resolve.sight import Sight

_NOWHERE = PackageLayout("")
_Compiled = tuple[File, str, tuple[str, ...]]
"""A file, with the package and the include folders of the source that it is compiled with."""


class Headers:
    """Follows includes through the files of a tree.

    Args:
        files: of the tree.
        sight: which packages see which.
        layouts: of packages, by name.
    """

    def __init__(self, files: Iterable[File], sight: Sight, layouts: Mapping[str, PackageLayout]) -> None:
        self._sight = sight
        self._layouts = layouts
        self._by_name: dict[str, list[File]] = defaultdict(list)
        self._reached: dict[File, Mapping[File, None]] = {}
        self._direct_of: dict[_Compiled, Sequence[File]] = {}
        for file in files:
            if file.language == "cpp":
                self._by_name[basename(file.path)].append(file)

    def of(self, file: File) -> Mapping[File, None]:
        """Return the headers that a file sees when it is compiled, directly or through others, in their order."""
        known = self._reached.get(file)
        if known is None:
            known = self._reached[file] = self._found(file)
        return known

    def _found(self, file: File) -> Mapping[File, None]:
        found: dict[File, None] = {}
        pending = [file]
        for each in pending:
            for header in self._direct(each, file):
                if header not in found and header is not file:
                    found[header] = None
                    pending.append(header)
        return found

    def _direct(self, file: File, unit: File) -> Sequence[File]:
        """What a file includes itself when it is compiled as a part of another; the same for sources built alike."""
        key = (file, unit.package, unit.include_folders)
        known = self._direct_of.get(key)
        if known is None:
            named = ((entry, self._by_name.get(entry.module.rpartition("/")[2])) for entry in file.facts.imports)
            found = (self._named(entry, file, unit, others) for entry, others in named if others)
            known = self._direct_of[key] = tuple([header for header in found if header is not None])
        return known

    def _named(self, entry: Import, file: File, unit: File, named: Sequence[File]) -> File | None:
        seen = self._sight.of(unit.package) | self._sight.of(file.package)
        by_path = {other.path: other for other in named if other.package in seen}
        for folder in self._folders(entry, file, unit):
            found = by_path.get(tree_path(folder, entry.module))
            if found is not None:
                return found
        fitting = [other for other in by_path.values() if _ends_with(other.path, entry.module)]
        exported = [other for other in fitting if self._is_exported(other, entry.module)]
        left = exported or fitting
        return left[0] if len(left) == 1 else None

    def _is_exported(self, other: File, module: str) -> bool:
        folder = other.path[: -len(module)].rstrip("/")
        return folder in self._layout(other.package).include_folders

    def _folders(self, entry: Import, file: File, unit: File) -> Iterator[str]:
        if not entry.angled:
            yield dirname(file.path)
        yield from unit.include_folders
        yield from self._layout(unit.package).include_folders
        yield from self._layout(file.package).include_folders

    def _layout(self, package: str) -> PackageLayout:
        return self._layouts.get(package, _NOWHERE)


def _ends_with(path: str, module: str) -> bool:
    return path == module or path.endswith(f"/{module.removeprefix('../')}")
