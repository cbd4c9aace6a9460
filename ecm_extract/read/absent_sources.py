"""Sources of programs and libraries that are not in the tree: a build makes them, and what they declare is not told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Final

from ecm_parsers.cmake_facts import Target

from ecm_extract.cmake.files import BuildFiles
from ecm_extract.cmake.sources import paths_of_source
from ecm_extract.exclusion import Exclusion
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import COMPILED
from ecm_extract.tree import FileDiagnostic, Tree, Unread, printable

_BINARY: Final = "${CMAKE_BINARY_DIR}/"
"""How the folder of the build is written in facts; other references may stand for any folder."""


@dataclass(frozen=True, slots=True)
class _Absent:
    """A source that is not in the tree: how it is written, its path, and of which target of which file it is one."""

    source: str
    path: str
    target: Target
    file: str


def report_absent(packages: Sequence[PackageFacts], files: BuildFiles, tree: Tree, exclude: Exclusion) -> None:
    """Tell the tree of sources that every build needs, by the target that they are of.

    What lies in a folder whose content this copy lacks (a submodule) is told as that, and not here. One that the
    project leaves out (`exclude`) is told, and is no gap.
    """
    for package in packages:
        for path, file in package.cmake.items():
            for target in file.targets:
                for absent in _absent(target, path, files):
                    tree.report(_told(absent, exclude.leaves_out(absent.path)))


def _absent(target: Target, file: str, files: BuildFiles) -> Iterator[_Absent]:
    """Yield the sources of a target that a build without settings compiles, and that are not in the tree."""
    needed = [source for source in target.sources if source not in target.optional and _is_one_file(source)]
    for source in needed if target.by_default and not target.is_test else ():
        meant = tuple(paths_of_source(source, file))
        lies_elsewhere = meant[0].startswith(("/", "..")) or files.is_absent(meant[0])
        if source.startswith(_BINARY):
            yield _Absent(source, source, target, file)
        elif not (lies_elsewhere or any(map(files.has, meant))):
            yield _Absent(source, meant[0], target, file)


def _is_one_file(source: str) -> bool:
    suffix = PurePosixPath(source).suffix.lower()
    return suffix in COMPILED and not set("*?[") & set(source) and "${" not in source.removeprefix(_BINARY)


def _told(absent: _Absent, is_excluded: bool) -> FileDiagnostic:
    advice = (
        "`exclude` leaves it out." if is_excluded else "Declare that in ecm.yaml, and name it in `[extract] exclude`."
    )
    text = (
        f"`{printable(absent.source)}`, a source of {printable(absent.target.name)}, is not in the tree: a build makes "
        f"it, or it is missing. What it declares is not told. {advice}"
    )
    unread = Unread(printable(absent.path), "excluded" if is_excluded else "generated")
    return FileDiagnostic("warning", "source-absent", printable(absent.file), absent.target.line, text, unread)
