"""Lines that stand in one branch of several: what is old there is kept for those who need it."""

from __future__ import annotations

import re

_CPP = tuple(re.compile(rb"\s*#\s*" + word) for word in (rb"if", rb"el", rb"endif"))
_CMAKE = tuple(re.compile(rb"\s*" + word + rb"\s*\(", re.IGNORECASE) for word in (rb"if", rb"else(?:if)?", rb"endif"))
_CHOOSES = re.compile(rb"ROS_DISTRO|ROS_VERSION|ROS_PYTHON_VERSION|rosdistro|rosversion|version_info", re.IGNORECASE)
"""What tells a distribution, or a version of Python, from another."""
_INDENT = re.compile(rb"[ \t]*")


def has_alternative(path: str, data: bytes, line: int) -> bool:
    """Tell whether a line is in one branch of several.

    Branches are conditions of the preprocessor and of CMake with a second one, and in Python a `try`, and what the
    distribution chooses.

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
    """Tell whether a block around a line is a `try`, or a branch that the version or distribution chooses."""
    own = _indent(lines[line - 1]) if 0 < line <= len(lines) else 0
    for at in range(min(line - 1, len(lines)) - 1, -1, -1):
        text = lines[at]
        if not text.strip() or _indent(text) >= own:
            continue
        own = _indent(text)
        if text.strip().startswith(b"try") or _CHOOSES.search(_condition(lines, at)):
            return True
    return False


def _condition(lines: list[bytes], at: int) -> bytes:
    """The `if` or `elif` at a line; of an `else` the branch before it."""
    own = _indent(lines[at])
    if not lines[at].strip().startswith(b"else"):
        return lines[at] if lines[at].strip().startswith((b"if", b"elif")) else b""
    before = (text for text in reversed(lines[:at]) if text.strip() and _indent(text) == own)
    return next((text for text in before if text.strip().startswith((b"if", b"elif"))), b"")


def _indent(text: bytes) -> int:
    match = _INDENT.match(text)
    return match.end() if match is not None else 0
