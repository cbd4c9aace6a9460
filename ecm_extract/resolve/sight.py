"""Which packages of a tree a package sees: repositories that only lie side by side have nothing to do with each other.

A package sees itself and, at any distance, the packages that its manifest and its build files name. Manifests are
often incomplete or missing: what an include or import names that none of these has, is in whatever packages do.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from ecm_extract.link.code.units import File
from ecm_extract.read.facts import PackageFacts

_Import = tuple[str, str]
"""Language and name: the path of a header, or the dotted name of a module."""


class Sight:
    """Answers which packages a package sees, each package asked about once."""

    def __init__(self, packages: Sequence[PackageFacts], files: Sequence[File]) -> None:
        self._all = frozenset(package.name for package in packages)
        self._declared = _declared(packages)
        self._offers = _Offers(files)
        self._imports = _imports(files)
        self._direct: dict[str, frozenset[str]] = {}
        self._seen: dict[str, frozenset[str]] = {}

    def of(self, package: str) -> frozenset[str]:
        """Return the names of the packages that a package sees."""
        known = self._seen.get(package)
        if known is None:
            known = self._seen[package] = self._reached(package)
        return known

    def _reached(self, package: str) -> frozenset[str]:
        reached = {package}
        pending = [package]
        while pending:
            found = self._next(pending.pop()) - reached
            reached |= found
            pending += found
        return frozenset(reached)

    def _next(self, package: str) -> frozenset[str]:
        known = self._direct.get(package)
        if known is None:
            known = self._direct[package] = self._named(package)
        return known

    def _named(self, package: str) -> frozenset[str]:
        declared = frozenset(self._declared[package] & self._all)
        near = {package, *declared}
        offered = (self._offers.of(entry) for entry in self._imports[package])
        return declared.union(*(found for found in offered if found.isdisjoint(near)))


class _Offer(NamedTuple):
    """A file as includes and imports name it: its path, the shortest name that means it, its package."""

    path: str
    least: str
    package: str


class _Offers:
    """Which packages have the file that an include or import names."""

    def __init__(self, files: Iterable[File]) -> None:
        self._by_last: Mapping[_Import, list[_Offer]] = defaultdict(list)
        listed = tuple(files)
        folders = frozenset(_folder(file.path) for file in listed if file.path.endswith("/__init__.py"))
        for file in listed:
            offer = _offer(file, folders)
            self._by_last[file.language, offer.path.rpartition("/")[2]].append(offer)

    def of(self, entry: _Import) -> set[str]:
        """Return the packages that have a file of that name."""
        language, name = entry
        found = self._by_last.get((language, name.rpartition("/")[2]), ())
        return {
            offer.package for offer in found if offer.path.endswith(f"/{name}") and f"/{name}".endswith(offer.least)
        }


def _folder(path: str) -> str:
    return path.rpartition("/")[0]


def _offer(file: File, packages: Container[str]) -> _Offer:
    """A module inside Python packages is named with all of them, so that `import logging` is none of theirs."""
    if file.language != "python":
        return _Offer(f"/{file.path}", "", file.package)
    path = file.path.removesuffix(".py").removesuffix("/__init__")
    top = _folder(path)
    while top in packages:
        top = _folder(top)
    return _Offer(f"/{path}", path.removeprefix(top), file.package)


def _imports(files: Iterable[File]) -> Mapping[str, set[_Import]]:
    found: Mapping[str, set[_Import]] = defaultdict(set)
    for file in files:
        found[file.package].update((file.language, name) for name in _named(file))
    return found


def _named(file: File) -> Iterator[str]:
    for entry in file.facts.imports:
        if file.language != "python":
            yield entry.module
        elif entry.module and not entry.module.startswith("."):
            module = entry.module.replace(".", "/")
            yield from (module, f"{module}/{entry.name}") if entry.name else (module,)


def _declared(packages: Iterable[PackageFacts]) -> Mapping[str, set[str]]:
    found: Mapping[str, set[str]] = defaultdict(set)
    for package in packages:
        builds = (entry.name for file in package.cmake.values() for entry in file.dependencies)
        manifest = package.manifest.dependencies if package.manifest is not None else ()
        found[package.name].update(builds, (entry.name for entry in manifest))
    return found
