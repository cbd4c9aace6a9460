"""Variables of other modules whose methods Python calls: of `from pkg.topics import NAMES` the call `NAMES.items()`.

What is called so is a method of what the variable holds, and no function of a module `pkg.topics.NAMES`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from ecm_parsers.source.expr import Expr, Lambda, Member, Name, Opaque

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import File, Func
from ecm_extract.resolve.cpp_constants import Stated

_NO_OBJECTS = (Name, Member, Lambda, Opaque)
"""What a variable is given that may stand for a class, a function or a module."""


def imported_variables(
    file: File, functions: Iterable[Func], constant: Callable[[str, File], Stated | None]
) -> frozenset[str]:
    """Return those that a file calls methods of, as it writes them; `constant` tells what a name means."""
    asked = {dotted for func in functions for dotted in _asked(func) if dotted.partition(".")[0] in file.imported}
    return frozenset(dotted for dotted in asked if _is_object(constant(dotted, file)))


def _asked(func: Func) -> Iterator[str]:
    """The dotted names of what a function calls methods of."""
    for call in (each for calls in func.calls for each in calls):
        if isinstance(call.callee, Member):
            yield dotted_name(call.callee.base)


def _is_object(found: Stated | None) -> bool:
    value: Expr | None = found.constant.value if found is not None else None
    return value is not None and not isinstance(value, _NO_OBJECTS)
