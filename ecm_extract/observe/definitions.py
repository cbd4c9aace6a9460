"""Message definitions as text: which fields two of them do not share."""

from __future__ import annotations

_SECTION = "=" * 80


def difference(one: str | None, two: str | None) -> str:
    """Return the first fields that only one side has, as the end of a sentence; empty when nothing is known."""
    if one is None or two is None:
        return ""
    first, second = _fields(one), _fields(two)
    only_first = [field for field in first if field not in second]
    only_second = [field for field in second if field not in first]
    if not only_first and not only_second:
        return ", in a type that it contains" if first == second else ", in another order"
    return f": {only_first[0] if only_first else 'nothing'} against {only_second[0] if only_second else 'nothing'}"


def _fields(text: str) -> list[str]:
    """Fields and constants of the type itself; the types that it contains follow below a line of `=`."""
    own = text.partition(_SECTION)[0]
    lines = (" ".join(line.partition("#")[0].split()) for line in own.splitlines())
    return [line for line in lines if line]
