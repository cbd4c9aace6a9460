"""What the install rules of a CMake package put where."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath
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
_PATTERN: Final = frozenset("*?[")
_MAKES_PACKAGE: Final = frozenset({"catkin_package", "ament_package"})


class InstallRule(msgspec.Struct, frozen=True):
    """One install rule.

    Attributes:
        kind: `TARGETS`, `PROGRAMS`, `DIRECTORY` or `FILES`.
        items: evaluated, from the folder of the file; a folder that ends in `/` gives its content only.
        destination: below the folder of installation, without `..`; what is not known stays a reference.
        words: keywords of the rule.
        renamed: what `RENAME` calls the only item; empty without it.
        by_default: whether a build without settings of its own takes it; None where that is not known.
    """

    kind: str
    items: tuple[str, ...]
    destination: str
    words: frozenset[str]
    path: str
    line: int
    renamed: str = ""
    by_default: bool | None = True

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
    kind, words = _KINDS[entry.kind], frozenset(entry.words)
    return InstallRule(kind, items, place, words, path, entry.line, entry.renamed, entry.by_default)


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
    items = (item for file in package.cmake.values() for install in file.installs for item in install.items)
    return is_unread(package) or any("$" in item for item in items)


def is_unread(package: PackageFacts) -> bool:
    """Tell whether a package may have rules that nothing shows, or nothing makes a package of the folder."""
    names = {command.name for file in package.cmake.values() for command in file.commands}
    if not makes_package(package) or "ament_auto_package" in names:
        return True
    return any(file.unknown for file in package.cmake.values())


def makes_package(package: PackageFacts) -> bool:
    """Tell whether a command of the build tools of ROS makes a package of the folder."""
    return any(command.name in _MAKES_PACKAGE for file in package.cmake.values() for command in file.commands)


def may_install_target(name: str, package: PackageFacts) -> bool:
    """Tell whether a rule with a name that only CMake knows may stand for a target."""
    installs = (install for file in package.cmake.values() for install in file.installs)
    return any(_may_be(name, item) for each in installs if each.kind == "targets" for item in each.items if "$" in item)


def may_install_file(path: str, package: PackageFacts, place: str = "") -> bool:
    """Tell whether a rule with a path that only CMake knows may put a file, or a folder around it, somewhere.

    Args:
        path: of the file, in the tree.
        package: whose rules are asked.
        place: first folder of the installation where the file would be needed; any when empty.
    """
    folders = [path, *(str(each) for each in PurePosixPath(path).parents)]
    for rule in install_rules(package):
        where = rule.destination.partition("/")[0]
        if rule.kind == "TARGETS" or (place and place != where and "$" not in where):
            continue
        names = folders if rule.kind == "DIRECTORY" else folders[:1]
        items = [item if item.startswith("$") else f"{rule.folder}{item}" for item in rule.items if "$" in item]
        if any(_may_be(name, item.rstrip("/")) for item in items for name in names):
            return True
    return False


def _may_be(name: str, item: str) -> bool:
    """Tell whether what stands before and behind the references of an item is that of a name.

    A reference at the start of a path may be any folder, also that of the tree.
    """
    head, _, rest = item.partition("$")
    tail = "" if _PATTERN & set(item) else rest[max(rest.rfind(mark) for mark in "}>") + 1 :]
    return name.startswith(head) and name.endswith(tail.lstrip("/"))
