"""Names in which parts are known at launch only: `/{robot}/scan`, braces inside braces included."""

from __future__ import annotations


def with_mark(text: str, mark: str) -> str:
    """Return a text with a mark for each part in braces."""
    found, depth = [], 0
    for char in text:
        if char == "{":
            found += [mark] if depth == 0 else []
            depth += 1
        elif char == "}":
            depth -= 1
        elif depth == 0:
            found.append(char)
    return "".join(found)
