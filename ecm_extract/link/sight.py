"""Which packages of a tree a package sees: repositories that only lie side by side have nothing to do with each other.

A package sees itself and, at any distance, the packages that its manifest and its build files name. Manifests are
often incomplete: what an include or import names that none of these has, is in whatever packages of the tree do.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

from ecm_extract.link.units import File
from ecm_extract.read.facts import PackageFacts

_Import = tuple[str, str]
"""Language and name: the path of a header, or the dotted name of a module."""


class Sight:
    """Answers which packages a package sees, each package asked about once."""

    def __init__(self, packages: Sequence[PackageFacts], files: Sequence[File]) -> None:
        self._all = frozenset(package.name for package in packages)
        self._open = frozenset(package.name for package in packages if not _is_stated(package))
        self._declared = _declared(packages)
        self._offers = _Offers(files)
        self._imports = _imports(files)
        self._seen: dict[str, frozenset[str]] = {}

    def of(self, package: str) -> frozenset[str]:
        """Return the names of the packages that a package sees; of one whose manifest cannot be read all."""
        known = self._seen.get(package)
        if known is None:
            known = self._seen[package] = self._all if package in self._open else self._reached(package)
        return known

    def _reached(self, package: str) -> frozenset[str]:
        reached = {package}
        pending = [package]
        while pending:
            found = self._direct(pending.pop()) - reached
            reached |= found
            pending += found
        return frozenset(reached)

    def _direct(self, package: str) -> set[str]:
        declared = self._declared[package] & self._all
        near = {package, *declared}
        offered = (self._offers.of(entry) for entry in self._imports[package])
        return declared.union(*(found for found in offered if found.isdisjoint(near)))


class _Offers:
    """Which packages have the file that an include or import names."""

    def __init__(self, files: Iterable[File]) -> None:
        self._by_last: Mapping[_Import, list[tuple[str, str]]] = defaultdict(list)
        for file in files:
            written = _importable(file)
            self._by_last[file.language, written.rpartition("/")[2]].append((f"/{written}", file.package))

    def of(self, entry: _Import) -> set[str]:
        """Return the packages that have a file of that name."""
        language, name = entry
        found = self._by_last.get((language, name.rpartition("/")[2]), ())
        return {package for path, package in found if path.endswith(f"/{name}")}


def _importable(file: File) -> str:
    """The path of a file as includes and imports end with it."""
    if file.language != "python":
        return file.path
    return file.path.removesuffix(".py").removesuffix("/__init__")


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


def _is_stated(package: PackageFacts) -> bool:
    """Tell whether a manifest could be read, so that it can say what the package depends on."""
    return package.manifest is not None and bool(package.manifest.name)


def _declared(packages: Iterable[PackageFacts]) -> Mapping[str, set[str]]:
    found: Mapping[str, set[str]] = defaultdict(set)
    for package in packages:
        builds = (entry.name for file in package.cmake.values() for entry in file.dependencies)
        manifest = package.manifest.dependencies if package.manifest is not None else ()
        found[package.name].update(builds, (entry.name for entry in manifest))
    return found
