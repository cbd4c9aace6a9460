"""Sources of programs and libraries that are not in the tree: a build makes them, and what they declare is not told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath
from posixpath import dirname, join, normpath
from typing import Final

from ecm_parsers.cmake_facts import Target

from ecm_extract.cmake.files import BuildFiles
from ecm_extract.cmake.sources import paths_of
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import COMPILED
from ecm_extract.tree import FileDiagnostic, Tree, Unread, printable

_BINARY: Final = "${CMAKE_BINARY_DIR}/"
"""How the folder of the build is written in facts; other references may stand for any folder."""


def report_absent(packages: Sequence[PackageFacts], files: BuildFiles, tree: Tree) -> None:
    """Tell the tree of sources that every build needs, by the target that they are of.

    What lies in a folder whose content this copy lacks (a submodule) is told as that, and not here.
    """
    for package in packages:
        for path, file in package.cmake.items():
            for target in file.targets:
                for source in _absent(target, path, files):
                    tree.report(_told(path, target, source))


def _absent(target: Target, path: str, files: BuildFiles) -> Iterator[str]:
    """Yield the sources of a target that a build without settings compiles, and that are not in the tree."""
    needed = [source for source in target.sources if source not in target.optional and _is_one_file(source)]
    for source in needed if target.by_default and not target.is_test else ():
        meant = tuple(paths_of(Target(target.name, target.kind, target.line, (source,)), path))
        lies_elsewhere = meant[0].startswith(("/", "..")) or files.is_absent(meant[0])
        if source.startswith(_BINARY) or not (lies_elsewhere or any(map(files.has, meant))):
            yield source


def _is_one_file(source: str) -> bool:
    suffix = PurePosixPath(source).suffix.lower()
    return suffix in COMPILED and not set("*?[") & set(source) and "${" not in source.removeprefix(_BINARY)


def _told(path: str, target: Target, source: str) -> FileDiagnostic:
    shown, place = printable(source), printable(path)
    text = (
        f"`{shown}`, a source of {printable(target.name)}, is not in the tree: a build makes it, or it is missing. "
        "What it declares is not told; declare that in ecm.yaml."
    )
    lies_at = shown if source.startswith(_BINARY) else printable(normpath(join(dirname(path), source)))
    return FileDiagnostic("warning", "source-absent", place, target.line, text, Unread(lies_at, "generated"))
