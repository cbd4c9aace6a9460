"""Templates of C++: what stands for their parameters, by the types that are written for it."""

from __future__ import annotations

from collections.abc import Container, Sequence

from ecm_extract.link.code.numbers import same_number
from ecm_extract.link.code.spelling import last_name, template_arguments

_QUALIFIERS = ("const ", "typename ", "struct ", "class ", "volatile ")


def unified(pattern: str, written: str, names: Container[str]) -> dict[str, str]:
    """Return what template parameters are if a type that mentions them is the written one; empty if it cannot be.

    Args:
        pattern: a type as the template writes it, `std::vector<T> &`.
        written: the type that stands in its place, `std::vector<int>`.
        names: the template parameters.
    """
    bare, given = unqualified(pattern), unqualified(written)
    if bare in names:
        return {bare: given} if given else {}
    mine, its = template_arguments(bare), template_arguments(given)
    if len(mine) != len(its) or _head(bare) != _head(given):
        return {}
    parts = (unified(*pair, names) for pair in zip(mine, its, strict=True))
    return {name: found for part in parts for name, found in part.items()}


def unqualified(written: str) -> str:
    """Return a type without qualifiers in front of it, references and pointers."""
    text = written.strip().rstrip("&* ")
    while text.startswith(_QUALIFIERS):
        text = text.split(" ", 1)[1].lstrip()
    return text.removesuffix(" const").rstrip("&* ")


def alike(one: Sequence[str], other: Sequence[str]) -> bool:
    """Tell whether template arguments are the same as far as both are known, whatever their namespaces."""
    return all(_key(mine) == _key(its) for mine, its in zip(one, other, strict=False) if mine and its)


def _key(written: str) -> str:
    bare = unqualified(written)
    return same_number(bare) or f"{_head(bare)}<{','.join(map(_key, template_arguments(bare)))}>"


def _head(bare: str) -> str:
    """The name of a type without namespaces and template arguments; what follows those stays: `A<T>::Ptr` is `Ptr`."""
    before, _, behind = bare.partition("<")
    tail = behind.rpartition(">")[2]
    return last_name(tail if "::" in tail else before).replace(" ", "")
