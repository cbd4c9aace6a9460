"""Patterns of texts in their order with something unknown between each two.

A plain `a.*b.*c` tries all ways to part a text that does not fit, of which there are more than a machine can try when
somebody writes twenty gaps. The first way that fits up to a text leaves most for those behind it, so no other is tried.
"""

from __future__ import annotations

from collections.abc import Sequence


def with_gaps(texts: Sequence[str], gap: str) -> str:
    """Return a regular expression of texts with a gap between each two.

    Args:
        texts: regular expressions, at least one; each fits what it fits whatever stands before and behind.
        gap: a regular expression that ends in `*` or `+`; what it repeats does not matter to the texts.
    """
    first, *others = texts
    if not others:
        return first
    *between, last = others
    return first + "".join(f"(?>{gap}?{text})" for text in between) + gap + last
