"""Which files the targets of a package are made of."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from posixpath import dirname, join, normpath
from typing import Final

from ecm_parsers.cmake_facts import CmakeFile, Target

_SUFFIXES: Final = ("", ".c", ".C", ".c++", ".cc", ".cpp", ".cxx", ".cu")
"""CMake tries these where a source is named without its own (CMP0115)."""
_WILD: Final = frozenset("*?[")


def built_sources(files: Mapping[str, CmakeFile]) -> frozenset[str] | None:
    """Return the paths of all that the targets of a package may be made of; None where that is not known.

    Files without any target say nothing: something else builds the package. A source that is named without a suffix
    is there with each that it may have.
    """
    if any(file.unknown or file.foreign for file in files.values()):
        return None
    targets = [(path, target) for path, file in files.items() for target in file.targets]
    if not targets or any(target.is_open or "$" in target.name or _has_pattern(target) for _, target in targets):
        return None
    return frozenset(name for path, target in targets for name in paths_of(target, path))


def paths_of(target: Target, file: str) -> Iterator[str]:
    """Yield the paths of the tree that the sources of a target may stand for.

    Args:
        target: with sources from the folder of its file.
        file: that makes it.
    """
    for source in target.sources:
        yield from paths_of_source(source, file)


def paths_of_source(source: str, file: str) -> Iterator[str]:
    """Yield the paths of the tree that one source of a target may stand for, that it is named by first."""
    path = normpath(join(dirname(file), source))
    yield from (path + suffix for suffix in _SUFFIXES)


def _has_pattern(target: Target) -> bool:
    return any(_WILD & set(source) for source in target.sources)
