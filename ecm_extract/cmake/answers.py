"""What conditions ask of a run beside its variables."""

from __future__ import annotations

from typing import Final

from ecm_extract.cmake.file_commands import exists, is_directory
from ecm_extract.cmake.known import commands
from ecm_extract.cmake.run import Run

_MAKERS: Final = frozenset({"add_executable", "add_library"})


class Answers:
    """Answers from what ran so far; None is not known, because others may have made it."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def is_target(self, name: str) -> bool | None:
        """Tell whether a target is there."""
        by_default = self._run.targets.get(name, False)
        if by_default is True:
            return True
        may_be = by_default is None or bool(self._run.found.unread) or self._run.brought.may_make(name)
        return None if may_be else False

    def is_command(self, name: str) -> bool | None:
        """Tell whether a command is there."""
        lower = name.lower()
        if lower in commands() | _MAKERS or lower in self._run.functions:
            return True
        return None if self._run.outside.has_any else False

    def oldest_cmake(self) -> str | None:
        """Return the version that the files ask for."""
        return ".".join(map(str, self._run.minimum)) or None

    def exists(self, path: str) -> bool | None:
        """Tell whether a file or folder is there."""
        return exists(self._run.files, path, self._run.folder())

    def is_directory(self, path: str) -> bool | None:
        """Tell whether a folder is there."""
        return is_directory(self._run.files, path)
