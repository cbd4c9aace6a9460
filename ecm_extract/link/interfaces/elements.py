"""Types of elements of vectors, matrices and quaternions of C++, which have them as their first template argument."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

from ecm_parsers.source.expr import Call, Expr, Member

from ecm_extract.link.code.spelling import plain, template_arguments
from ecm_extract.link.code.templates import unqualified
from ecm_extract.shipped import shipped, shipped_names

_TABLE: Final = "link/interfaces/elements.toml"
_HOLDERS: Final = shipped_names(_TABLE, "holders")
_ELEMENTS: Final = shipped_names(_TABLE, "elements")
_ALIKE: Final = shipped_names(_TABLE, "alike")
_ALIASES: Final[Mapping[str, str]] = shipped(_TABLE)["aliases"]


def element_given(call: Call, type_of: Callable[[Expr], str]) -> str:
    """Return the type of the element that a call gives: `double` of `v(0)` and of `q.vec()(1)`; empty for other calls.

    Args:
        call: the call.
        type_of: gives the type of a variable, or of a part of one, as written.
    """
    held = _held(call, type_of)
    return template_arguments(held)[0] if held else ""


def spelled_out(written: str) -> str:
    """Return what a name of a holder stands for, with its arguments; other types as they are."""
    return _ALIASES.get(unqualified(written), written)


def _held(call: Call, type_of: Callable[[Expr], str]) -> str:
    """The type of what a call takes an element from: what a method gives one of, or what is called itself."""
    callee = call.callee
    return _holder(callee.base if isinstance(callee, Member) and callee.name in _ELEMENTS else callee, type_of)


def _holder(expr: Expr, type_of: Callable[[Expr], str]) -> str:
    if isinstance(expr, Call):
        callee = expr.callee
        return _holder(callee.base, type_of) if isinstance(callee, Member) and callee.name in _ALIKE else ""
    written = spelled_out(type_of(expr))
    return written if plain(written) in _HOLDERS and template_arguments(written) else ""
