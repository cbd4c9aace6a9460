"""`cmake_dependent_option` (cmake-modules(7), CMakeDependentOption)."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_parsers.cmake_tokens import Argument

from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.conditions import holds
from ecm_extract.cmake.lists import items
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.set_commands import option
from ecm_extract.cmake.state import both


class _Nothing:
    """A build of which only the variables are known."""

    def is_target(self, name: str) -> bool | None:
        return None

    def is_command(self, name: str) -> bool | None:
        return None

    def exists(self, path: str) -> bool | None:
        return None

    def is_directory(self, path: str) -> bool | None:
        return None

    def oldest_cmake(self) -> str | None:
        return None


def dependent_option(args: list[str], look: Look) -> Sequence[Change]:
    """`cmake_dependent_option(NAME text value conditions otherwise)`: an option where all conditions hold."""
    if len(args) < 5:
        return []
    verdict: bool | None = True
    for condition in items(args[3]):
        words = condition.replace("(", " ( ").replace(")", " ) ").split()
        header = tuple(Argument(word, 0, "plain") for word in words)
        verdict = both(verdict, holds(header, look, _Nothing()))
    if verdict is None:
        return not_known(args[0])
    return option(args[:3], look) if verdict else [Change(args[0], args[4])]
