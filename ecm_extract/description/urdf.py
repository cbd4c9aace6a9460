"""URDF: links and joints of an expanded description.

Source: wiki.ros.org/urdf/XML.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from ecm_extract.description.element import Element
from ecm_extract.description.model import Joint, Link, Where

_LIMITS = ("lower", "upper", "effort", "velocity")
_COORDINATES = 6


def links_of(root: Element) -> Iterator[Link]:
    """Yield the links."""
    return (Link(entry.get("name"), Where(entry.path, entry.line)) for entry in root.below("link"))


def joints_of(root: Element) -> Iterator[Joint]:
    """Yield the joints."""
    for element in root.below("joint"):
        parent, child, mimic = element.first("parent"), element.first("child"), element.first("mimic")
        limit = element.first("limit")
        written = {name: limit.get(name) for name in _LIMITS if limit.get(name)} if limit is not None else {}
        yield Joint(
            element.get("name"),
            element.get("type"),
            parent.get("link") if parent is not None else "",
            child.get("link") if child is not None else "",
            {name: number for name, text in written.items() if (number := number_of(text)) is not None},
            mimic.get("joint") if mimic is not None else None,
            Where(element.path, element.line),
            _origin(element.first("origin")),
        )


def _origin(element: Element | None) -> tuple[float, ...] | None:
    """Position and angles; what is not written is zero."""
    texts = [(element.get(name) if element is not None else "") or "0 0 0" for name in ("xyz", "rpy")]
    numbers = [number_of(part) for text in texts for part in text.split()]
    known = tuple(number for number in numbers if number is not None)
    return known if len(known) == len(numbers) == _COORDINATES else None


def number_of(text: str) -> float | None:
    """Return the finite number that a text spells, None for anything else."""
    try:
        number = float(text)
    except ValueError:
        return None
    return number if math.isfinite(number) else None
