"""Lines that stand in one branch of several: what is old there is kept for those who need it."""

from __future__ import annotations

import re

_CPP = tuple(re.compile(rb"\s*#\s*" + word) for word in (rb"if", rb"el", rb"endif"))
_CMAKE = tuple(re.compile(rb"\s*" + word + rb"\s*\(", re.IGNORECASE) for word in (rb"if", rb"else(?:if)?", rb"endif"))
_INDENT = re.compile(rb"[ \t]*")


def has_alternative(path: str, data: bytes, line: int) -> bool:
    """Tell whether a line is in a condition of the preprocessor or of CMake with a second branch, or in a `try`.

    Args:
        path: of the file, whose ending tells the language.
        data: its content.
        line: 1-based.
    """
    lines = data.splitlines()
    if path.endswith(".py"):
        return _is_tried(lines, line)
    opens, other, closes = _CMAKE if path.endswith(("CMakeLists.txt", ".cmake")) else _CPP
    blocks: list[list[int]] = []
    for at, text in enumerate(lines, 1):
        if opens.match(text):
            blocks.append([at, 0])
        elif other.match(text) and blocks:
            blocks[-1][1] = 1
        elif closes.match(text) and blocks:
            start, branched = blocks.pop()
            if start < line < at and branched:
                return True
    return False


def _is_tried(lines: list[bytes], line: int) -> bool:
    """Tell whether the line that begins the block around a line is `try:`; a statement may go over several lines."""
    own = _indent(lines[line - 1]) if 0 < line <= len(lines) else 0
    for text in reversed(lines[: line - 1]):
        if not text.strip() or _indent(text) >= own:
            continue
        own = _indent(text)
        if text.strip().endswith(b":"):
            return text.strip().startswith(b"try")
    return False


def _indent(text: bytes) -> int:
    match = _INDENT.match(text)
    return match.end() if match is not None else 0
