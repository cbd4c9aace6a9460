"""Which targets may come from outside of the tree: of packages that are found, by commands of theirs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fnmatch import fnmatchcase

from ecm_extract.cmake.known import known


class Brought:
    """Packages that were looked for and commands of theirs that ran."""

    def __init__(self) -> None:
        self._patterns: dict[str, None] = {}
        self._is_open = False

    def find(self, packages: Iterable[str]) -> None:
        """Remember packages; of one that is not in the table any target may come."""
        for name in packages:
            patterns = known().brought.get(name)
            self._is_open = self._is_open or patterns is None
            self._patterns.update(dict.fromkeys(patterns or ()))

    def run(self, command: str, words: Sequence[str]) -> None:
        """Remember a command from elsewhere: those of the table make targets that hold a word of theirs."""
        if command in known().makers.names:
            self._patterns.update(dict.fromkeys(f"*{word}*" for word in words if word))
        elif command not in known().quiet.names:
            self._is_open = True

    def may_make(self, name: str) -> bool:
        """Tell whether a target of this name may be there."""
        return self._is_open or any(fnmatchcase(name, pattern) for pattern in self._patterns)
