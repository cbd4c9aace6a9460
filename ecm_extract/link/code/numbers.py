"""Types of numbers in C++ and the type of parameter that each is."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from ecm_parsers.numbers import truncated
from ecm_parsers.source.expr import Constant, Expr, Number, Text

from ecm_extract.link.code.spelling import plain

NUMBERS: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(("int", "uint", "long", "short", "unsigned", "size_t"), "integer")
    | {f"{sign}int{bits}_t": "integer" for sign in ("", "u") for bits in (8, 16, 32, 64)}
    | {"double": "double", "float": "double"}
)


def as_number(value: Any, name: str) -> Any:
    """Return a number as the type of that name holds it; other data stay as they are."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    kind = NUMBERS.get(name)
    whole = truncated(value) if kind == "integer" else None
    return float(value) if kind == "double" else value if whole is None else whole


def kind_of_type(written: str) -> str:
    """Return whether a type is one of texts or of numbers, nothing for others."""
    last = plain(written).rsplit("::", 1)[-1]
    if last in {"string", "string_view"} or (last == "char" and "*" in written):
        return "text"
    return "number" if last in NUMBERS or last == "bool" else ""


def nothing_of(written: str) -> Expr | None:
    """Return what an element of a container is that is given nothing: an empty text, zero; None of other types."""
    kind, last = kind_of_type(written), plain(written).rsplit("::", 1)[-1]
    if not kind or "*" in written:
        return None
    if kind == "text":
        return Text("") if last == "string" else None
    return Constant("false") if last == "bool" else Number(as_number(0, last))
