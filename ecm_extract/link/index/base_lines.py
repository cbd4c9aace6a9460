"""The order in which Python looks through the bases of a class (docs.python.org: "Method Resolution Order")."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_extract.link.code.units import Cls


def merged_lines(lines: Sequence[Sequence[Cls]]) -> tuple[Cls, ...] | None:
    """Return the bases of a class in order, by the order of each base and that of the bases; None where they differ."""
    pending = [list(line) for line in (*lines, [line[0] for line in lines if line]) if line]
    found: list[Cls] = []
    while pending:
        heads = (line[0] for line in pending)
        chosen = next((head for head in heads if not any(head in line[1:] for line in pending)), None)
        if chosen is None:
            return None
        found.append(chosen)
        pending = [rest for line in pending if (rest := [each for each in line if each is not chosen])]
    return tuple(found)
