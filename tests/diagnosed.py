"""What parsers say of a text that nobody meant them to read."""

from __future__ import annotations

from typing import Any

from ecm_parsers.result import Parsed


def is_told(data: bytes, *results: Parsed[Any]) -> bool:
    """Whether each diagnostic has a message, and a line of the text that it was made of."""
    lines = len(data.splitlines()) + 1
    return all(0 <= each.line <= lines and bool(each.message) for parsed in results for each in parsed.diagnostics)
