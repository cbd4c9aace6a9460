"""Element types of standard containers, by how the type is written."""

from __future__ import annotations

from typing import Final

from ecm_extract.link.spelling import plain, template_arguments

ELEMENT_METHODS: Final = frozenset({"at", "front", "back", "top"})

_OF_FIRST: Final = frozenset({"vector", "array", "deque", "list", "set", "unordered_set", "span", "stack", "queue"})
_OF_SECOND: Final = frozenset({"map", "unordered_map", "multimap"})


def element_type(written: str) -> str:
    """Type of what a container or an array holds; of a map the values. Empty for anything else."""
    text = written.strip().removeprefix("const ").rstrip("& ")
    if text.endswith("[]"):
        return text.removesuffix("[]")
    name = plain(text).rsplit("::", 1)[-1]
    held = template_arguments(text)
    if name in _OF_FIRST and held:
        return held[0]
    return held[1] if name in _OF_SECOND and len(held) > 1 else ""
