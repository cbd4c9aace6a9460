"""What the commands of CMake files say, whatever arm they stand in."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.cmake_facts import CmakeFile

from ecm_extract.read.facts import PackageFacts

_BRING: Final = frozenset({"externalproject_add", "fetchcontent_makeavailable", "fetchcontent_populate"})
MAX_TEXT: Final = 400


def calls_any(package: PackageFacts, names: frozenset[str]) -> bool:
    """Tell whether a build file of a package has one of some commands, in any arm."""
    return any(command.name in names for file in package.cmake.values() for command in file.commands)


def words_of(package: PackageFacts) -> Iterator[str]:
    """Yield the arguments of all commands of a package, as written."""
    return (word.text for file in package.cmake.values() for command in file.commands for word in command.args)


def brings_targets(package: PackageFacts) -> bool:
    """Tell whether what CMake downloads, or files that it includes by a pattern, may make targets of a package."""
    included = (entry.path for file in package.cmake.values() for entry in file.subdirectories)
    return any("*" in path for path in included) or calls_any(package, _BRING)


def folded(text: str, file: CmakeFile, package: str) -> str:
    """Put the project and the variables of the file in; what is not known stays a reference."""
    for name, value in (("PROJECT_NAME", package), *file.variables.items()):
        text = text.replace(f"${{{name}}}", value) if len(text) + len(value) < MAX_TEXT else text
    return text
