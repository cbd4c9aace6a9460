"""Texts that are printed to a buffer are cut where it ends: the last byte is the end of the text.

Source: `snprintf` of ISO C, 7.21.6.5.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ecm_extract.link.running.values import Value, lowered


def cut(texts: Iterable[Value], room: Sequence[Value]) -> tuple[Value, ...]:
    """Return what stands in a buffer of some bytes; a text that may not fit is what is there by default.

    Args:
        texts: what may be printed.
        room: the bytes that the buffer may have.
    """
    sizes = [value.data for value in room]
    if len(sizes) != 1 or not isinstance(sizes[0], int) or sizes[0] < 1:
        return lowered(tuple(texts), "default")
    return tuple([_cut(text, sizes[0] - 1) for text in texts])


def _cut(text: Value, length: int) -> Value:
    """A text that is too long without its end; where that is cannot be told behind what is not known."""
    whole = all(isinstance(part, str) for part in text.parts)
    return text._replace(parts=(text.text[:length],), template=()) if whole and len(text.text) > length else text
