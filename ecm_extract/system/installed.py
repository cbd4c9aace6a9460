"""Files of the share folder of a package that lie elsewhere in the tree, by the install rules that put them there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from posixpath import join, normpath

from ecm_checker.hub.running import CopiedPath
from ecm_parsers.cmake_facts import Install

from ecm_extract.read.facts import PackageFacts

_COPIED = frozenset({"directory", "files"})


class Installed:
    """Where files are copied from."""

    def __init__(self, rows: Iterable[CopiedPath]) -> None:
        self._rows = tuple(rows)

    def sources(self, path: str) -> Iterator[str]:
        """Yield the paths in the tree from which a path in a share folder may be copied."""
        for row in self._rows:
            if path == row.named or path.startswith(f"{row.named}/".lstrip("/")):
                yield row.source + path.removeprefix(row.named)


def copied_paths(package: PackageFacts) -> Iterator[CopiedPath]:
    """Yield what the CMake files of a package copy into its share folder."""
    for path, file in package.cmake.items():
        for install in file.installs:
            if install.kind in _COPIED and "$" not in install.destination:
                yield from _of(install, path.rpartition("/")[0], package)


def _of(install: Install, folder: str, package: PackageFacts) -> Iterator[CopiedPath]:
    share, _, below = install.destination.strip("/").removeprefix("share/").partition("/")
    if share != package.name or not install.destination.startswith("share/"):
        return
    for item in install.items:
        source = normpath(join(folder, item))
        if "$" not in item and not source.startswith(".."):
            name = "" if item.endswith("/") else install.renamed or source.rpartition("/")[2]
            yield CopiedPath(normpath(join(package.root.path, below, name)), source)
