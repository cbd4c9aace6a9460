"""White space in types of C++, which stand on several lines as they like."""

from __future__ import annotations


def collapsed(written: str) -> str:
    """Return a type on one line: a single space where some was, none behind `::`."""
    return " ".join(written.split()).replace(":: ", "::")
