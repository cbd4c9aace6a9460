"""Which source files of a package others can see: installed headers and importable Python modules."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import PurePosixPath

from ecm_parsers.cmake_facts import FileReference

from ecm_extract.entities.include_folders import may_hold_headers, passed_over
from ecm_extract.entities.installed_packages import InstalledPackages
from ecm_extract.entities.paths import inside
from ecm_extract.entities.program_files import of_programs, script_modules
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import is_included

_NO_PACKAGES = frozenset({"src", "test", "tests", "example", "examples"})
_HEADERS = "INCLUDE_DIRS"
HIDDEN = frozenset({"detail", "details", "internal", "impl", "_internal", "private", "anonymous"})


def public_headers(facts: PackageFacts) -> dict[str, str]:
    """Return the path of each public header with what a consumer writes in its `#include`.

    Public is what lies below the package's `include/`, or what the build files install; nothing below `include/`
    is when they install much else and never that, nor one of several such folders that they pass over. What only
    programs have the code of is not: nobody can link it.
    """
    installed = _installed_headers(facts)
    kept_back = _keeps_headers(facts)
    found: dict[str, str] = {}
    for entry in facts.root.files:
        parts = entry.path.split("/")
        if not is_included(entry.path) or not HIDDEN.isdisjoint(parts):
            continue
        include = _below_include(inside(entry.path, facts.root.path))
        if include is not None and not kept_back:
            found[entry.path] = include
        elif entry.path in installed:
            found[entry.path] = f"{facts.name}/{parts[-1]}"
    hidden = of_programs(facts) | (passed_over(facts, found) - installed)
    return {path: include for path, include in found.items() if path not in hidden}


def _keeps_headers(facts: PackageFacts) -> bool:
    """Whether a package installs things, but no headers; one without any such line is used where it lies.

    There catkin finds the folders that it is told of, and no other.
    """
    installs = [entry for file in facts.cmake.values() for entry in file.installs]
    if not installs:
        told = [each for file in facts.cmake.values() for each in file.commands if each.name == "catkin_package"]
        return bool(told) and not any(_HEADERS in each.args for each in told)
    return not any(may_hold_headers(entry) for entry in installs if entry.kind in {"directory", "files"})


def _below_include(path: str) -> str | None:
    """`include/a/b.hpp` -> `a/b.hpp`; a doubled package folder (`include/a/a/b.hpp`) is dropped once."""
    parts = path.split("/")
    if "include" not in parts[:-1]:
        return None
    rest = parts[parts.index("include") + 1 :]
    if len(rest) > 2 and rest[0] == rest[1]:
        rest = rest[1:]
    return "/".join(rest)


def _installed_headers(facts: PackageFacts) -> set[str]:
    listed = {entry.path for entry in facts.root.files}
    found = set()
    for path, file in facts.cmake.items():
        folder = str(PurePosixPath(path).parent)
        prefix = "" if folder == "." else f"{folder}/"
        for entry in file.installs:
            if entry.kind == "files" and "include" in entry.destination.lower():
                found |= {prefix + item for item in entry.items} & listed
    return found


def python_modules(facts: PackageFacts) -> dict[str, str]:
    """Return the path of each module that is there to be imported, with its dotted name; see `script_modules`."""
    found = _importable(facts)
    programs = script_modules(facts, found)
    return {path: dotted for path, dotted in found.items() if dotted not in programs}


def program_modules(facts: PackageFacts) -> dict[str, str]:
    """Return the path of each module that is a program: nobody is meant to import it, and whoever does can."""
    found = _importable(facts)
    programs = script_modules(facts, found)
    return {path: dotted for path, dotted in found.items() if dotted in programs}


def _importable(facts: PackageFacts) -> dict[str, str]:
    """The path of each importable module with its dotted name; names with an underscore are private."""
    roots, installed = _import_roots(facts), InstalledPackages(facts)
    found = {}
    for path, source in facts.sources.items():
        if source.language != "python" or not path.endswith(".py"):
            continue
        below = inside(path, facts.root.path)
        root = next((root for root in roots if below.startswith(root)), None)
        if root is None or below.removeprefix(root).split("/")[0] in _NO_PACKAGES:
            continue
        if not installed.have(root, below.removeprefix(root).removesuffix(".py").split("/")[0]):
            continue
        dotted = below.removeprefix(root).removesuffix(".py").replace("/", ".").removesuffix(".__init__")
        if not any(part.startswith("_") for part in dotted.split(".")):
            found[path] = dotted
    return found


def stub_modules(facts: PackageFacts) -> Iterator[str]:
    """Yield the dotted names of compiled modules that have a stub (`.pyi`) in an importable package."""
    roots = _import_roots(facts)
    for entry in facts.root.files:
        below = inside(entry.path, facts.root.path)
        root = next((root for root in roots if below.startswith(root)), None) if below.endswith(".pyi") else None
        if root is not None:
            yield below.removeprefix(root).removesuffix(".pyi").replace("/", ".").removesuffix(".__init__")


def _import_roots(facts: PackageFacts) -> list[str]:
    """Folders that import packages lie in: `` or `src/`; a package of the own name is always importable."""
    stated = any(setup.packages for setup in facts.setups.values())
    stated = stated or any(file.python_packages for file in facts.cmake.values())
    if not stated:
        return []
    prefixes = {folder.strip("./") for setup in facts.setups.values() for folder in setup.package_dir.values()}
    roots = [f"{folder}/" if folder else "" for folder in sorted(prefixes, reverse=True)]
    roots += [f"{folder}/" for file in facts.cmake.values() for folder in _package_folders(file.python_packages)]
    packages = {
        "/".join(PurePosixPath(inside(path, facts.root.path)).parts[:-1])
        for path in facts.sources
        if path.endswith("/__init__.py")
    }
    found = []
    for root in [*roots, "src/", ""]:
        tops = {name.removeprefix(root).split("/")[0] for name in packages if name.startswith(root)}
        found += [f"{root}{top}/" for top in tops if top and top not in _NO_PACKAGES]
    return [entry.rsplit("/", 2)[0] + "/" if "/" in entry.rstrip("/") else "" for entry in found]


def _package_folders(named: Iterable[FileReference]) -> Iterator[str]:
    """Folders that installed packages lie in, where they are told: `PACKAGE_DIR python/arm`."""
    return (entry.path.rpartition("/")[0] for entry in named if "/" in entry.path and "$" not in entry.path)
