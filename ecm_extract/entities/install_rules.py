"""What the install rules of a CMake package put where."""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import join, normpath
from typing import Final

import msgspec
from ecm_parsers.cmake_facts import Install

from ecm_extract.read.facts import PackageFacts

_KINDS: Final = {
    "targets": "TARGETS",
    "programs": "PROGRAMS",
    "python": "PROGRAMS",
    "directory": "DIRECTORY",
    "files": "FILES",
}
_MAKES_PACKAGE: Final = frozenset({"catkin_package", "ament_package"})


class InstallRule(msgspec.Struct, frozen=True):
    """One install rule.

    Attributes:
        kind: `TARGETS`, `PROGRAMS`, `DIRECTORY` or `FILES`.
        items: evaluated, from the folder of the file; a folder that ends in `/` gives its content only.
        destination: below the folder of installation, without `..`; what is not known stays a reference.
        words: keywords of the rule.
        renamed: what `RENAME` calls the only item; empty without it.
    """

    kind: str
    items: tuple[str, ...]
    destination: str
    words: frozenset[str]
    path: str
    line: int
    renamed: str = ""

    @property
    def folder(self) -> str:
        """The folder of the CMakeLists.txt, with a slash unless it is the root."""
        head = self.path.rpartition("/")[0]
        return f"{head}/" if head else ""


def install_rules(package: PackageFacts) -> Iterator[InstallRule]:
    """Yield the install rules of a package."""
    for path, file in package.cmake.items():
        yield from (_rule(entry, path) for entry in file.installs)


def place_of(path: str, rule: InstallRule) -> str | None:
    """Return where a rule puts a file, None when it leaves it out."""
    for item in rule.items:
        full = f"{rule.folder}{item}"
        if rule.kind == "FILES" and path == full:
            return join(rule.destination, rule.renamed or path.rpartition("/")[2])
        if rule.kind == "DIRECTORY" and path.startswith(full.rstrip("/") + "/"):
            start = full if full.endswith("/") else full.rpartition("/")[0]
            return join(rule.destination, path.removeprefix(start).lstrip("/"))
    return None


def _rule(entry: Install, path: str) -> InstallRule:
    items = tuple(item.removeprefix("./") for item in entry.items)
    place = normpath(f"/{entry.destination}").strip("/")
    return InstallRule(_KINDS[entry.kind], items, place, frozenset(entry.words), path, entry.line, entry.renamed)


def lives_in_devel_space(package: PackageFacts) -> bool:
    """Tell whether a package that is not of ROS 2 installs nothing at all: it runs from where it was built."""
    return package.ros != 2 and next(install_rules(package), None) is None


def tells_installed(package: PackageFacts) -> bool:
    """Tell whether all that a package installs is known, and there is something."""
    return not is_open(package) and not lives_in_devel_space(package)


def installed_targets(package: PackageFacts) -> set[str]:
    """Return the targets that install rules name."""
    installs = [install for file in package.cmake.values() for install in file.installs]
    return {item for install in installs if install.kind == "targets" for item in install.items}


def is_open(package: PackageFacts) -> bool:
    """Tell whether a rule installs what only CMake knows, or nothing makes a package of the folder."""
    names = {command.name for file in package.cmake.values() for command in file.commands}
    if not names & _MAKES_PACKAGE or "ament_auto_package" in names:
        return True
    items = [item for file in package.cmake.values() for install in file.installs for item in install.items]
    return any(file.unknown for file in package.cmake.values()) or any("$" in item for item in items)
