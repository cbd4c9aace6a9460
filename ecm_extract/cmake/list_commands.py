"""`list(...)` (cmake-list(7)); forms that are not here make their variable unknown."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable, Sequence
from typing import Final

from ecm_extract.cmake import patterns
from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.genex import stripped
from ecm_extract.cmake.lists import items
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.values import is_known

_Form = Callable[[list[str], list[str], Look], "list[str] | None"]
_INTEGER: Final = re.compile(r"[+-]?\d+")


def run_list(args: list[str], look: Look) -> Sequence[Change]:
    """Run one `list(ACTION NAME ...)`."""
    if len(args) < 2:
        return []
    action, name, rest = args[0], args[1], args[2:]
    text = look.built_up(name)
    if action in _READERS:
        return _READERS[action](items(text), rest)
    if action in _POPS:
        return _popped(name, items(text), rest, _POPS[action])
    if action == "TRANSFORM" and "OUTPUT_VARIABLE" in rest:
        at = rest.index("OUTPUT_VARIABLE")
        target, rest = "".join(rest[at + 1 : at + 2]) or name, rest[:at]
    else:
        target = name
    form = _CHANGES.get(action)
    grows = action in _GROWING or (action == "INSERT" and rest[:1] == ["0"])
    found = form(items(text), rest, look) if form is not None and (is_known(text) or grows) else None
    return not_known(target) if found is None else [Change(target, _text(found))]


def _text(values: list[str]) -> str:
    return ";".join(values)


# -- that read a list


def _length(values: list[str], rest: list[str]) -> Sequence[Change]:
    return _told(rest[:1], str(len(values)), values)


def _get(values: list[str], rest: list[str]) -> Sequence[Change]:
    places = [_place(text, len(values)) for text in rest[:-1]]
    known = all(place is not None for place in places) and all(is_known(value) for value in values)
    picked = _text([values[place] for place in places if place is not None])
    return _told(rest[-1:], picked, values) if known else not_known(rest[-1]) if rest else []


def _find(values: list[str], rest: list[str]) -> Sequence[Change]:
    at = values.index(rest[0]) if len(rest) > 1 and rest[0] in values else -1
    return _told(rest[1:2], str(at), [*values, *rest[:1]])


def _join(values: list[str], rest: list[str]) -> Sequence[Change]:
    return _told(rest[1:2], "".join(rest[:1]).join(values), [])


def _sublist(values: list[str], rest: list[str]) -> Sequence[Change]:
    if len(rest) < 3 or not all(_INTEGER.fullmatch(text) for text in rest[:2]):
        return not_known(rest[-1]) if rest else []
    start, length = int(rest[0]), int(rest[1])
    return _told(rest[2:3], _text(values[start:] if length < 0 else values[start : start + length]), values)


def _told(names: list[str], text: str, values: list[str]) -> Sequence[Change]:
    """Set the variable that an answer goes to; an answer about what is not known is not known."""
    if not names:
        return []
    return [Change(names[0], text)] if all(is_known(value) for value in values) else not_known(names[0])


_READERS: Final = {"LENGTH": _length, "GET": _get, "FIND": _find, "JOIN": _join, "SUBLIST": _sublist}


# -- that take from a list


_POPS: Final = {"POP_BACK": -1, "POP_FRONT": 0}


def _popped(name: str, values: list[str], targets: list[str], end: int) -> Sequence[Change]:
    if not all(is_known(value) for value in values):
        return [change for each in (name, *targets) for change in not_known(each)]
    taken: list[Change] = []
    for target in targets or [""]:
        value = values.pop(end) if values else None
        taken += [Change(target, value)] if target else []
    return [Change(name, _text(values)), *taken]


# -- that change a list


def _append(values: list[str], rest: list[str], look: Look) -> list[str]:
    del look
    return [*values, *rest]


def _prepend(values: list[str], rest: list[str], look: Look) -> list[str]:
    del look
    return [*rest, *values]


def _insert(values: list[str], rest: list[str], look: Look) -> list[str] | None:
    del look
    at = _place("".join(rest[:1]), len(values), end=True)
    return None if at is None else [*values[:at], *rest[1:], *values[at:]]


def _remove_item(values: list[str], rest: list[str], look: Look) -> list[str] | None:
    del look
    return [value for value in values if value not in rest] if all(is_known(value) for value in rest) else None


def _remove_at(values: list[str], rest: list[str], look: Look) -> list[str] | None:
    del look
    places = [_place(text, len(values)) for text in rest]
    return None if None in places else [value for at, value in enumerate(values) if at not in places]


def _remove_duplicates(values: list[str], rest: list[str], look: Look) -> list[str]:
    del rest, look
    return list(dict.fromkeys(values))


def _reverse(values: list[str], rest: list[str], look: Look) -> list[str]:
    del rest, look
    return values[::-1]


_SORTED_BY: Final[dict[str, Callable[[str], str]]] = {"STRING": str, "FILE_BASENAME": posixpath.basename}


_KEPT_IN_ORDER: Final = 16
"""So many items at most stay in their order where they compare equal: `std::sort` inserts them one by one."""


def _sort(values: list[str], rest: list[str], look: Look) -> list[str] | None:
    del look
    words = dict(zip(rest[::2], rest[1::2], strict=False))
    part = _SORTED_BY.get(words.get("COMPARE", "STRING"))
    if part is None or words.keys() - {"COMPARE", "CASE", "ORDER"}:
        return None
    is_folded = words.get("CASE") == "INSENSITIVE"
    keys = {value: (part(value).lower() if is_folded else part(value)).encode() for value in values}
    if len(set(keys.values())) < len(keys) and len(values) > _KEPT_IN_ORDER:
        return None
    return sorted(values, key=keys.__getitem__, reverse=words.get("ORDER") == "DESCENDING")


def _filter(values: list[str], rest: list[str], look: Look) -> list[str] | None:
    del look
    if len(rest) != 3 or rest[0] not in {"INCLUDE", "EXCLUDE"} or rest[1] != "REGEX":
        return None
    compiled = patterns.pattern(rest[2])
    if compiled is None or not is_known(rest[2]) or not all(patterns.is_cheap(compiled, value) for value in values):
        return None
    return [value for value in values if (compiled.search(value) is not None) == (rest[0] == "INCLUDE")]


def _transform(values: list[str], rest: list[str], look: Look) -> list[str] | None:
    del look
    action = "".join(rest[:1])
    count = _TRANSFORM_WORDS.get(action)
    chosen = None if count is None else _selected(values, rest[1 + count :])
    if chosen is None or count is None or not all(is_known(word) for word in rest):
        return None
    changed = [
        _transformed(action, rest[1 : 1 + count], value) if at in chosen else value for at, value in enumerate(values)
    ]
    return None if None in changed else [value for value in changed if value is not None]


_TRANSFORM_WORDS: Final = {
    "APPEND": 1,
    "PREPEND": 1,
    "REPLACE": 2,
    "TOLOWER": 0,
    "TOUPPER": 0,
    "STRIP": 0,
    "GENEX_STRIP": 0,
}


def _transformed(action: str, words: list[str], value: str) -> str | None:
    if action == "REPLACE":
        return patterns.replaced(words[0], words[1], value)
    if action == "GENEX_STRIP":
        return stripped(value)
    simple = {"TOLOWER": value.lower(), "TOUPPER": value.upper(), "STRIP": value.strip()}
    added = {"APPEND": value + "".join(words), "PREPEND": "".join(words) + value}
    return {**simple, **added}[action]


def _selected(values: list[str], words: list[str]) -> set[int] | None:
    """Places that `AT`, `FOR` or `REGEX` select; all without one, None where that is not known."""
    if not words:
        return set(range(len(values)))
    if words[0] == "AT":
        places = [_place(word, len(values)) for word in words[1:]]
        return None if None in places else {place for place in places if place is not None}
    if words[0] == "REGEX" and len(words) == 2:
        compiled = patterns.pattern(words[1])
        if compiled is not None and all(patterns.is_cheap(compiled, value) for value in values):
            return {at for at, value in enumerate(values) if compiled.search(value)}
    if words[0] == "FOR" and 3 <= len(words) <= 4 and all(_INTEGER.fullmatch(word) for word in words[1:]):
        start, stop, step = (*(int(word) for word in words[1:]), 1)[:3]
        return set(range(start, min(stop, len(values) - 1) + 1, step)) if step > 0 else None
    return None


def _place(text: str, length: int, end: bool = False) -> int | None:
    """Index of an item as written, from the end where it is negative; None for one that is not there."""
    if not _INTEGER.fullmatch(text):
        return None
    at = int(text) + (length if int(text) < 0 else 0)
    return at if 0 <= at < length + end else None


_CHANGES: Final[dict[str, _Form]] = {
    "APPEND": _append,
    "PREPEND": _prepend,
    "INSERT": _insert,
    "REMOVE_ITEM": _remove_item,
    "REMOVE_AT": _remove_at,
    "REMOVE_DUPLICATES": _remove_duplicates,
    "REVERSE": _reverse,
    "SORT": _sort,
    "FILTER": _filter,
    "TRANSFORM": _transform,
}
_GROWING: Final = frozenset({"APPEND", "PREPEND"})
"""What adds to a list whose other items may not be known."""
