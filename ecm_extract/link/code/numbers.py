"""Types of numbers in C++: their sizes, and the type of parameter that each is.

Source: en.cppreference.com, "Fundamental types"; an `int` has 32 bits and a `long` 64, as on the platforms of REP 2000.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

from ecm_parsers.numbers import truncated
from ecm_parsers.source.expr import Constant, Expr, Number, Text

from ecm_extract.link.code.spelling import plain

BITS: Final[Mapping[str, int]] = MappingProxyType(
    {"char": 8, "short": 16, "int": 32, "long": 64, "size_t": 64, "ssize_t": 64, "uint": 32, "ushort": 16, "uchar": 8}
    | {f"{sign}int{bits}_t": bits for sign in ("", "u") for bits in (8, 16, 32, 64)}
)
"""Bits of the types of whole numbers, in their short form."""
WITHOUT_SIGN: Final = frozenset({"size_t", "uint", "ushort", "uchar"} | {f"uint{bits}_t" for bits in (8, 16, 32, 64)})
CHARACTERS: Final = frozenset({"char", "int8_t", "uint8_t", "uchar"})
"""Types whose numbers a stream writes as characters."""
_LETTERS: Final = frozenset({"char", "uchar"})
NUMBERS: Final[Mapping[str, str]] = MappingProxyType(
    {name: "integer" for name in (*BITS, "unsigned") if name not in _LETTERS} | {"double": "double", "float": "double"}
)
"""Types of numbers, each with the type of the parameters that it is declared with."""
_OTHER: Final = frozenset("*[<")
"""What stands in the types of pointers, arrays and templates."""
_WORDS: Final = frozenset({"unsigned", "signed", "const", "constexpr", "static", "volatile"})


def as_number(value: Any, name: str) -> Any:
    """Return a number as the type of parameter of that name holds it; other data stay as they are."""
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


def type_of_number(written: str) -> str:
    """Return a type of numbers in its short form: `unsigned int` is `uint`; empty for other types."""
    if _OTHER.intersection(written):
        return ""
    words = [word.rsplit("::", 1)[-1] for word in written.replace("&", " ").split()]
    kinds = [word for word in words if word not in _WORDS]
    sign = "u" if "unsigned" in words else ""
    if not kinds:
        return f"{sign}int" if {"unsigned", "signed"} & set(words) else ""
    first = "long" if "long" in kinds and "double" not in kinds else kinds[-1]
    if first in {"float", "double", "bool"}:
        return first
    found = {"long": "size_t"}.get(first, f"u{first}") if sign else first
    return found if found in BITS else ""


def same_number(written: str) -> str:
    """Return a text that two types of numbers share which are one type: `unsigned` and `uint32_t`; empty for others."""
    name = type_of_number(written)
    if name not in BITS or name in _LETTERS:
        return name
    return f"{'u' * (name in WITHOUT_SIGN)}int{BITS[name]}"
