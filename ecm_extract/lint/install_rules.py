"""What the install rules of a CMake package put where, with the words that its facts leave out."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from ecm_parsers.cmake_facts import CmakeFile

from ecm_extract.entities.cmake_words import folded
from ecm_extract.read.facts import PackageFacts

_COMMANDS = frozenset({"install", "catkin_install_python"})
_KINDS = frozenset({"TARGETS", "PROGRAMS", "DIRECTORY", "FILES"})
_WORDS = frozenset(
    {
        "DESTINATION",
        "TYPE",
        "PERMISSIONS",
        "FILE_PERMISSIONS",
        "DIRECTORY_PERMISSIONS",
        "USE_SOURCE_PERMISSIONS",
        "CONFIGURATIONS",
        "COMPONENT",
        "RENAME",
        "OPTIONAL",
        "EXCLUDE_FROM_ALL",
        "FILES_MATCHING",
        "MESSAGE_NEVER",
        "PATTERN",
        "REGEX",
        "EXPORT",
        "ARCHIVE",
        "LIBRARY",
        "RUNTIME",
        "OBJECTS",
        "INCLUDES",
        "PUBLIC_HEADER",
        "PRIVATE_HEADER",
        "RESOURCE",
    }
)
_FOLDERS = (
    ("CATKIN_PACKAGE_BIN_DESTINATION", "lib/{package}"),
    ("CATKIN_PACKAGE_INCLUDE_DESTINATION", "include/{package}"),
    ("CATKIN_PACKAGE_SHARE_DESTINATION", "share/{package}"),
    ("CATKIN_PACKAGE_LIB_DESTINATION", "lib"),
    ("CATKIN_GLOBAL_BIN_DESTINATION", "bin"),
    ("CATKIN_GLOBAL_INCLUDE_DESTINATION", "include"),
    ("CATKIN_GLOBAL_SHARE_DESTINATION", "share"),
    ("CATKIN_GLOBAL_LIB_DESTINATION", "lib"),
    ("CMAKE_INSTALL_PREFIX", ""),
    ("CMAKE_INSTALL_INCLUDEDIR", "include"),
    ("CMAKE_INSTALL_LIBDIR", "lib"),
    ("CMAKE_INSTALL_BINDIR", "bin"),
)


class InstallRule(msgspec.Struct, frozen=True):
    """One install rule.

    Attributes:
        kind: `TARGETS`, `PROGRAMS`, `DIRECTORY` or `FILES`.
        items: as written, evaluated, from the folder of the file; a folder that ends in `/` gives its content only.
        destination: below the folder of installation; what is not known stays a reference.
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
        for name, args, line in _installs(file, package.name):
            kind = args[0] if name == "install" and args else ""
            if kind in _KINDS:
                yield _rule(kind, args[1:], path, line, package.name)
            elif name == "catkin_install_python":
                yield _rule("PROGRAMS", args[args[:1] == ("PROGRAMS",) :], path, line, package.name)


def _installs(file: CmakeFile, package: str) -> Iterator[tuple[str, tuple[str, ...], int]]:
    """Name, arguments and line of the commands that install, with what is known at the end of the file put in."""
    for call in file.calls:
        if call.name in _COMMANDS:
            yield call.name, tuple(folded(text, file, package) for text in call.args), call.line


def place_of(path: str, rule: InstallRule) -> str | None:
    """Return where a rule puts a file, None when it leaves it out."""
    for item in rule.items:
        full = f"{rule.folder}{item}"
        if rule.kind == "FILES" and path == full:
            return f"{rule.destination}/{rule.renamed or path.rpartition('/')[2]}"
        if rule.kind == "DIRECTORY" and path.startswith(full.rstrip("/") + "/"):
            start = full if full.endswith("/") else full.rpartition("/")[0]
            return f"{rule.destination}/{path.removeprefix(start).lstrip('/')}"
    return None


def _rule(kind: str, args: tuple[str, ...], path: str, line: int, package: str) -> InstallRule:
    end = next((at for at, arg in enumerate(args) if arg in _WORDS), len(args))
    items = tuple(item.removeprefix("./") for item in args[:end])
    place, renamed = _below(_after("DESTINATION", args), package), _after("RENAME", args)
    return InstallRule(kind, items, place, frozenset(_WORDS & set(args)), path, line, renamed)


def _after(word: str, args: tuple[str, ...]) -> str:
    return next((args[at + 1] for at, arg in enumerate(args[:-1]) if arg == word), "")


def _below(destination: str, package: str) -> str:
    for name, value in _FOLDERS:
        destination = destination.replace(f"${{{name}}}", value.format(package=package))
    return destination.replace("//", "/").strip("/")


def lives_in_devel_space(package: PackageFacts) -> bool:
    """Tell whether a package that is not of ROS 2 installs nothing at all: it runs from where it was built."""
    return package.ros != 2 and next(install_rules(package), None) is None
