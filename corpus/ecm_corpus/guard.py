"""The wall between a blind run and the story: what the process of the run may not open.

An audit hook cannot be removed again, and worker processes inherit it.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Final

NARRATIVE: Final = "narrative"
"""Name of the folder that a blind run must not look into."""

_TOUCHING: Final = frozenset({"open", "os.listdir", "os.scandir", "os.rename", "os.link", "os.symlink", "glob.glob"})
_STARTING: Final = frozenset({"subprocess.Popen", "os.exec", "os.posix_spawn", "os.system", "os.startfile"})
_ALLOWED_PROGRAMS: Final = frozenset({"git"})


class BlindnessError(RuntimeError):
    """A blind run reached for what it must not know."""


def shut_out_narratives() -> None:
    """From here on, opening a narrative or starting a program other than git raises `BlindnessError`."""
    sys.addaudithook(_refuse)


def _refuse(event: str, arguments: tuple[object, ...]) -> None:
    if event in _TOUCHING:
        for argument in arguments[:2]:
            if isinstance(argument, str | bytes | os.PathLike) and _is_narrative(argument):
                message = f"a blind run must not open {os.fsdecode(argument)}"
                raise BlindnessError(message)
    elif event in _STARTING and not _is_allowed(arguments):
        message = f"a blind run must not start {arguments[0]!r}"
        raise BlindnessError(message)


def _is_narrative(path: str | bytes | os.PathLike[str] | os.PathLike[bytes]) -> bool:
    """By the name that is asked for, and by the file that it leads to."""
    text = os.fsdecode(path)
    return NARRATIVE in Path(text).parts or NARRATIVE in Path(os.path.realpath(text)).parts


def _is_allowed(arguments: tuple[object, ...]) -> bool:
    program = arguments[0] if arguments else None
    return isinstance(program, str | bytes | os.PathLike) and Path(os.fsdecode(program)).name in _ALLOWED_PROGRAMS
