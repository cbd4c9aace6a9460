"""Which parameter types take what another one took, without a change of the caller's source."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Final

_TEMPLATE: Final = re.compile(r"(?:const )?\$[A-Z]&{0,2}")
"""A parameter of a function template, as `signatures.template_names` writes it."""
_INTEGER: Final = re.compile(r"\b(?:long (?:long|double)|unsigned (?:long|int|char|short)|long|unsigned|size_t|int)\b")
_SIZED: Final = {
    "unsigned long": "uint64_t",
    "size_t": "uint64_t",
    "long": "int64_t",
    "unsigned int": "uint32_t",
    "unsigned": "uint32_t",
    "int": "int32_t",
    "unsigned short": "uint16_t",
    "unsigned char": "uint8_t",
}
"""One type each where robots run: `long` has 64 bits there, `int` 32."""
_WIDTHS: Final = {
    "bool": (1, 1),
    "uint8_t": (8, 9),
    "int8_t": (8, 8),
    "uint16_t": (16, 17),
    "int16_t": (16, 16),
    "uint32_t": (32, 33),
    "int32_t": (32, 32),
    "uint64_t": (64, 65),
    "int64_t": (64, 64),
}
"""Bits of an integer, and the bits that a signed one needs to hold all its values."""


@lru_cache(maxsize=20_000)
def sized(written: str) -> str:
    """Return a type with its integers by their size, so that `long` and `int64_t` are one."""
    return _INTEGER.sub(lambda match: _SIZED.get(match.group(), match.group()), written)


def takes(new: str, old: str) -> bool:
    """Whether whatever fits the old type of a parameter fits the new one: `T&`, `T`, `const T&` fit `const T&`."""
    if _TEMPLATE.fullmatch(new):
        return True
    after, before = sized(new), sized(old)
    bare = _bare(before)
    if after in {before, f"const {bare}&"} or (after == bare and not bare.endswith("&")):
        return True
    target = _bare(after)
    by_value = not after.endswith("&") or (after.startswith("const ") and not target.endswith("*"))
    return by_value and _converts(target, bare)


def returns_as_well(new: str, old: str) -> bool:
    """Whether a caller that was content with what a function returned is so still; who got nothing takes anything."""
    return old == "void" or sized(new) == sized(old)


def _bare(text: str) -> str:
    """Without reference and `const`, which of a pointer is that of its target."""
    bare = text.removesuffix("&")
    return bare if bare.endswith("*") else bare.removeprefix("const ")


def _converts(new: str, old: str) -> bool:
    """Whether a value goes over by itself and unchanged: to a wider number, to a pointer to const."""
    if (old, new) == ("float", "double"):
        return True
    if old in _WIDTHS and new in _WIDTHS:
        bits, signed_bits = _WIDTHS[old]
        if _is_unsigned(new):
            return _is_unsigned(old) and _WIDTHS[new][0] >= bits
        return _WIDTHS[new][0] >= signed_bits
    if old.endswith("*"):
        return new == f"const {old}"
    return old.endswith("Ptr") and not old.endswith("ConstPtr") and new == f"{old.removesuffix('Ptr')}ConstPtr"


def _is_unsigned(name: str) -> bool:
    return name == "bool" or name.startswith("u")
