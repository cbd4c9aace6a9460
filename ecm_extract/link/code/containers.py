"""Standard containers, pairs and tuples of C++: their element types, and what makes them."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.cpp_containers import holds_several
from ecm_parsers.source.expr import Call, Name

from ecm_extract.link.code.spelling import last_name, plain, template_arguments
from ecm_extract.shipped import shipped_names

_TABLE: Final = "link/code/library_values.toml"
_GROWING: Final = shipped_names(_TABLE, "growing")
_MAPS: Final = shipped_names(_TABLE, "maps")
_OF_FIRST: Final = _GROWING | shipped_names(_TABLE, "other_sequences")
_OF_SECOND: Final = _MAPS | shipped_names(_TABLE, "multimaps")
_TUPLES: Final = shipped_names(_TABLE, "tuples")
KEEPING: Final = shipped_names(_TABLE, "keeping")
"""Calls that give the list that they are given."""
PAIR: Final = ("first", "second")
"""Fields of a pair."""
ELEMENT_METHODS: Final = frozenset({"at", "front", "back", "top"})


def element_type(written: str) -> str:
    """Type of what a container or an array holds; of a map the values. Empty for anything else."""
    text = written.strip().removeprefix("const ").rstrip("& ")
    if text.endswith("[]"):
        return text.removesuffix("[]")
    name = last_name(plain(text))
    held = template_arguments(text)
    if name in _OF_FIRST and held:
        return held[0]
    return held[1] if name in _OF_SECOND and len(held) > 1 else ""


def looped_type(written: str) -> str:
    """Type of what a loop over a container or an array gives: of a map pairs. Empty for anything else."""
    parts = parts_of_elements(written)
    return f"std::pair<{', '.join(parts)}>" if len(parts) > 1 else element_type(written)


def part_of_pair(written: str, name: str) -> str:
    """Type of a part of a pair, by its name. Empty for anything else."""
    held = template_arguments(written) if last_name(plain(written)) == "pair" else ()
    return dict(zip(PAIR, held, strict=False)).get(name, "")


def parts_of_elements(written: str) -> tuple[str, ...]:
    """Types of what the elements of a container consist of: its keys, too, of a map. Empty for anything else."""
    text = written.strip().removeprefix("const ").rstrip("& ")
    name, held = last_name(plain(text)), template_arguments(text)
    if name in _OF_FIRST:
        return held[:1]
    return held[:2] if name in _OF_SECOND and len(held) > 1 else ()


def is_map(written: str) -> bool:
    """Tell whether a type, as it is written, is a table with one value for each key."""
    return last_name(plain(written)) in _MAPS


def is_container(written: str) -> bool:
    """Tell whether a type, as it is written, is a container."""
    return holds_several(plain(written))


def begins_empty(written: str) -> bool:
    """Tell whether an object of a type that is given nothing is a container without elements."""
    return last_name(plain(written)) in _GROWING | _MAPS


def makes_tuple(call: Call) -> bool:
    """Tell whether a call makes a pair or a tuple of what it is given."""
    return isinstance(call.callee, Name) and call.callee.id in _TUPLES


def is_tuple(written: str) -> bool:
    """Tell whether a type, as it is written, is a pair or a tuple."""
    return f"std::{last_name(plain(written))}" in _TUPLES
