"""Lines of a change: which a patch touches, and where in the new file something stood that is gone."""

from __future__ import annotations

from difflib import SequenceMatcher
from typing import Final

from unidiff.errors import UnidiffParseError
from unidiff.patch import PatchSet

from ecm_extract.errors import InputError

MAX_LINES = 6_000


class PatchError(InputError):
    """A patch that cannot be read."""


_FORM: Final = "give a unified diff, as `git diff` writes it"


def touched_lines(text: str) -> dict[str, set[int]]:
    """Return the lines that a patch adds or that stand beside what it removes, by path of the new file.

    Raises:
        PatchError: it is no unified diff.
    """
    try:
        patch = PatchSet(text)
    except UnidiffParseError as error:
        message = f"the patch cannot be read: {error}"
        raise PatchError(message, _FORM) from None
    except ValueError:
        message = "the patch cannot be read: a line number of it has thousands of digits"
        raise PatchError(message, _FORM) from None
    found: dict[str, set[int]] = {}
    for file in patch:
        lines = found.setdefault(file.path, set())
        for hunk in file:
            for line in hunk:
                if line.is_added and line.target_line_no is not None:
                    lines.add(line.target_line_no)
            if not any(line.is_added for line in hunk):
                lines.add(max(hunk.target_start, 1))
    return found


def landing_line(old: bytes | None, new: bytes | None, line: int) -> int:
    """Return the line of the new file where a line of the old one is, or stood before it was removed."""
    if old is None or new is None:
        return 1
    one, two = old.splitlines()[:MAX_LINES], new.splitlines()[:MAX_LINES]
    for tag, i1, i2, j1, j2 in SequenceMatcher(None, one, two, autojunk=False).get_opcodes():
        if i1 <= line - 1 < i2:
            return (j1 + (line - 1 - i1) if tag == "equal" else min(j1, max(len(two) - 1, 0))) + 1
        del j2
    return 1
