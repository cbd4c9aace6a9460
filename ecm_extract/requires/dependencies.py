"""Packages that a package depends on, and libraries of theirs that it links: package.xml and CMake."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.hub.condition import Condition
from ecm_checker.hub.requirement import Requirement

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required

_NO_PACKAGES: Final = frozenset({"group_depend", "member_of_group", "conflict", "replace"})
"""Elements of package.xml that name groups, or packages that are not to be there (REP 149)."""


def dependency_requirements(facts: PackageFacts) -> Iterator[Requirement]:
    """Yield the packages and libraries that the build files of a package name."""
    yield from _of_manifest(facts)
    for path, file in facts.cmake.items():
        for entry in file.dependencies:
            yield _package(entry.name, Place(path, entry.line, f"file {path}"))
        for target in file.targets:
            for link in target.links:
                yield from _library(link, Place(path, target.line, f"file {path}"))


def _of_manifest(facts: PackageFacts) -> Iterator[Requirement]:
    path, manifest = facts.root.manifest, facts.manifest
    if path is None or manifest is None:
        return
    for entry in manifest.dependencies:
        if entry.kind not in _NO_PACKAGES:
            conditions = (entry.condition,) if entry.condition else ()
            yield _package(entry.name, Place(path, entry.line, f"file {path}"), conditions)


def _package(name: str, place: Place, conditions: tuple[str, ...] = ()) -> Requirement:
    when = tuple(Condition("expression", each) for each in conditions)
    return required("depends", name, place, "likely", conditions=conditions, when=when)


def _library(link: str, place: Place) -> Iterator[Requirement]:
    """An exported target is written with its package: `tf2_ros::tf2_ros` (ament_cmake, "Ament CMake user docs")."""
    package, mark, name = link.partition("::")
    if mark and name and "$" not in link:
        yield required("links", name, place, "likely", package=package)
