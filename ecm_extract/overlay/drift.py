"""Where a declaration contradicts what the source shows. More detail is no contradiction."""

from __future__ import annotations

from typing import Any

MAX_SHOWN = 80


def contradiction(declared: Any, inferred: Any) -> str | None:
    """Return what differs, None when the declaration holds all that was inferred.

    A list may add items and must not leave any out; a map may add keys; numbers and texts must be equal.
    """
    if isinstance(inferred, list):
        given = declared if isinstance(declared, list) else [declared]
        lost = [item for item in inferred if item not in given]
        return f"{_shown(lost)} is left out" if lost else None
    if isinstance(inferred, dict) and isinstance(declared, dict):
        for key, value in inferred.items():
            inner = contradiction(declared[key], value) if key in declared else None
            if inner is not None:
                return f"{key}: {inner}"
        return None
    if _number(inferred) and _number(declared):
        return None if inferred == declared else f"{declared} here, {inferred} there"
    same = declared == inferred and isinstance(declared, bool) is isinstance(inferred, bool)
    return None if same else f"{_shown(declared)} here, {_shown(inferred)} there"


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _shown(value: Any) -> str:
    text = ", ".join(map(str, value)) if isinstance(value, list) else str(value)
    return text if len(text) <= MAX_SHOWN else f"{text[: MAX_SHOWN - 1]}…"
