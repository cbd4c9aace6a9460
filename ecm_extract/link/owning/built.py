"""The files of packages as their build sees them: those that no target compiles are no part of any program."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Set
from pathlib import PurePosixPath
from posixpath import dirname, join, normpath

from ecm_extract.cmake.sources import built_sources, paths_of
from ecm_extract.link.code.units import File
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import COMPILED


def files_of(packages: Iterable[PackageFacts]) -> list[File]:
    """Return the source files of packages, each with what the build makes of it."""
    return [file for package in packages for file in _of_package(package)]


def _of_package(package: PackageFacts) -> Iterator[File]:
    folders = _include_folders(package)
    built = built_sources(package.cmake)
    dead = _dead(package, built) if built is not None else frozenset()
    targets = _targets(package)
    for path, facts in package.sources.items():
        looked_in = folders.get(path, ())
        yield File(
            path,
            package.name,
            package.ros,
            facts,
            include_folders=looked_in,
            is_built=path not in dead,
            targets=targets.get(path, ()),
            all_targets=built is not None,
        )


def _dead(package: PackageFacts, built: Set[str]) -> frozenset[str]:
    """C++ sources that no target compiles and no file includes."""
    included = {PurePosixPath(entry.module).name for facts in package.sources.values() for entry in facts.imports}
    names = (PurePosixPath(path) for path in package.sources)
    return frozenset(
        str(path) for path in names if path.suffix in COMPILED and str(path) not in built and path.name not in included
    )


def _include_folders(package: PackageFacts) -> Mapping[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = defaultdict(tuple)
    for path, file in package.cmake.items():
        for target in file.targets:
            folders = tuple(normpath(join(dirname(path), each)) for each in target.include_folders if "$" not in each)
            for source in paths_of(target, path):
                found[source] = tuple(dict.fromkeys((*found[source], *folders)))
    return found


def _targets(package: PackageFacts) -> Mapping[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = defaultdict(tuple)
    for path, file in package.cmake.items():
        for target in file.targets:
            for source in paths_of(target, path):
                found[source] = (*found[source], target.name)
    return found
