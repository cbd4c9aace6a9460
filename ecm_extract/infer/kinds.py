"""Exceptions by type: what a type derives from, and whether a handler is for it."""

from __future__ import annotations

import builtins
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Protocol

from ecm_extract.link.code.spelling import last_name
from ecm_extract.shipped import shipped

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func


@dataclass(frozen=True, slots=True)
class Kind:
    """A type of exceptions.

    Attributes:
        name: what it is called in full. above: it and all that it derives from, by name.
        whole: whether it derives from nothing else.
    """

    name: str
    above: frozenset[str]
    whole: bool = True

    def fits(self, caught: Kind | None) -> bool | None:
        """Tell whether a handler for a type, None for one that nobody knows, is for this; None if that is open."""
        if caught is not None and caught.name in self.above:
            return True
        return False if caught is not None and self.whole else None


def any_fits(kinds: Iterable[Kind], caught: Iterable[Kind | None]) -> bool | None:
    """Tell whether a handler for some types is for what is one of several; None where that is open."""
    asked = tuple(caught)
    found = {_one_fits(kind, asked) for kind in kinds}
    return found.pop() if len(found) == 1 else None


def _one_fits(kind: Kind, caught: Iterable[Kind | None]) -> bool | None:
    found = {kind.fits(each) for each in caught}
    return True if True in found else None if None in found else False


@cache
def standard_kind(name: str, language: str) -> Kind | None:
    """Return a type of the standard library of a language; None of all others."""
    return _of_python(name) if language == "python" else _of_cpp(name)


def _of_python(name: str) -> Kind | None:
    found = getattr(builtins, name.removeprefix("builtins."), None)
    if not isinstance(found, type) or not issubclass(found, BaseException):
        return None
    return Kind(found.__name__, frozenset(base.__name__ for base in found.__mro__))


def _of_cpp(name: str) -> Kind | None:
    """Types with their bases as infer/raising.toml has them; what is no class derives from nothing."""
    bases = shipped("infer/raising.toml")["cpp"]["types"]
    last = last_name(name) if name.startswith("std::") else name
    if last not in bases:
        return None
    above = [last]
    while bases[above[-1]]:
        above.append(bases[above[-1]])
    return Kind(last, frozenset(above))


class Exceptions(Protocol):
    """Who knows types of exceptions, and what may be proved to raise."""

    def kind(self, spelled: str, func: Func) -> Kind | None:
        """Return the type of exceptions that is written so in a function; None for what is no type that is known."""

    def is_provable(self, func: Func, at: int, handled: bool) -> bool:
        """Tell whether a statement has anything of which it can be known that it raises.

        Args:
            func: the function.
            at: the statement.
            handled: also what it calls of the tree, which matters where somebody handles it.
        """
