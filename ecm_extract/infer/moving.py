"""Variables of C++ that are moved from: nobody knows what is left in them. Source: [lib.types.movedfrom]."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Name

from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.spelling import by_value

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func

_MOVE: Final = Name("std::move")
_FIXED: Final = frozenset({"const", "constexpr"})


def moved_from(call: Call, func: Func) -> Iterator[str]:
    """Yield the variable that a call moves from: a number, and what cannot be changed, stays what it is."""
    arg = call.args[0] if call.callee == _MOVE and len(call.args) == 1 else None
    written = func.written_types.get(arg.id, "") if isinstance(arg, Name) else ""
    if isinstance(arg, Name) and by_value(written) and not _FIXED & set(written.split()):
        yield from (arg.id,) if kind_of_type(written) != "number" else ()
