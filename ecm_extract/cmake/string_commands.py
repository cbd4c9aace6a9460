"""`string(...)` (cmake-string(7)); forms that are not here make their variable unknown."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Sequence
from functools import partial
from typing import Final

from ecm_extract.cmake import patterns
from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.genex import stripped
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.values import is_known, is_placed

_Form = Callable[[list[str], Look], Sequence[Change]]
_NO_LETTER: Final = re.compile(r"[^A-Za-z0-9_]")
_AT: Final = re.compile(r"@([A-Za-z0-9_./+-]+)@")
_BRACED: Final = re.compile(r"\$\{([A-Za-z0-9_./+-]+)\}")
_HASHES: Final = ("MD5", "SHA1", "SHA224", "SHA256", "SHA384", "SHA512", "SHA3_224", "SHA3_256", "SHA3_384", "SHA3_512")
_COMPARED: Final[dict[str, Callable[[str, str], bool]]] = {
    "LESS": lambda one, other: one < other,
    "GREATER": lambda one, other: one > other,
    "EQUAL": lambda one, other: one == other,
    "NOTEQUAL": lambda one, other: one != other,
    "LESS_EQUAL": lambda one, other: one <= other,
    "GREATER_EQUAL": lambda one, other: one >= other,
}


def run_string(args: list[str], look: Look) -> Sequence[Change]:
    """Run one `string(ACTION ...)`."""
    form = _FORMS.get(args[0]) if args else None
    try:
        return form(args[1:], look) if form is not None else _not_modelled(args)
    except IndexError:
        return []  # CMake refuses it for want of an argument


def _not_modelled(args: list[str]) -> Sequence[Change]:
    """The variable may be any of the words."""
    return [change for word in args[1:] for change in not_known(word) if word.isidentifier()]


def _told(name: str, text: str | None, *needed: str) -> Sequence[Change]:
    known = text is not None and all(is_known(each) for each in needed)
    return [Change(name, text)] if known else not_known(name)


def _case(change: Callable[[str], str]) -> _Form:
    def run(args: list[str], look: Look) -> Sequence[Change]:
        del look
        return _told(args[1], change(args[0]), args[0])

    return run


def _append(args: list[str], look: Look) -> Sequence[Change]:
    return [Change(args[0], look.built_up(args[0]) + "".join(args[1:]))]


def _prepend(args: list[str], look: Look) -> Sequence[Change]:
    return [Change(args[0], "".join(args[1:]) + look.built_up(args[0]))]


def _concat(args: list[str], look: Look) -> Sequence[Change]:
    del look
    return [Change(args[0], "".join(args[1:]))]


def _join(args: list[str], look: Look) -> Sequence[Change]:
    del look
    return [Change(args[1], args[0].join(args[2:]))]


def _replace(args: list[str], look: Look) -> Sequence[Change]:
    del look
    text = "".join(args[3:])
    return _told(args[2], text.replace(args[0], args[1]) if args[0] else text, args[0], args[1], text)


def _length(args: list[str], look: Look) -> Sequence[Change]:
    del look
    return _told(args[1], None if is_placed(args[0]) else str(len(args[0].encode())), args[0])


def _substring(args: list[str], look: Look) -> Sequence[Change]:
    del look
    text, start, length = args[0], args[1], args[2]
    known = text.isascii() and not is_placed(text) and start.isdigit() and length.lstrip("-").isdigit()
    end = int(start) + int(length) if known and int(length) >= 0 else None
    return _told(args[3], text[int(start) : end] if known else None, text)


def _find(args: list[str], look: Look) -> Sequence[Change]:
    del look
    text, wanted = args[0], args[1]
    at = text.rfind(wanted) if "REVERSE" in args[3:] else text.find(wanted)
    return _told(args[2], None if is_placed(text) and at > 0 else str(at), text, wanted)


def _repeat(args: list[str], look: Look) -> Sequence[Change]:
    del look
    known = args[1].isdigit() and int(args[1]) < 1_000
    return _told(args[2], args[0] * int(args[1]) if known else None, args[0])


def _identifier(args: list[str], look: Look) -> Sequence[Change]:
    del look
    text = _NO_LETTER.sub("_", args[0])
    return _told(args[1], None if is_placed(args[0]) else f"_{text}" if text[:1].isdigit() else text, args[0])


def _compare(args: list[str], look: Look) -> Sequence[Change]:
    del look
    compare = _COMPARED.get(args[0])
    told = None if compare is None else "1" if compare(args[1], args[2]) else "0"
    return _told(args[3], told, args[1], args[2])


def _configure(args: list[str], look: Look) -> Sequence[Change]:
    text = args[0] if "@ONLY" in args[2:] else _BRACED.sub(lambda match: look.get(match[1]) or "", args[0])
    return _told(args[1], _AT.sub(lambda match: look.get(match[1]) or "", text))


def _last_match_gone(look: Look) -> Sequence[Change]:
    """Which match was the last one is not followed here."""
    names = [f"{patterns.MATCH}{at}" for at in (*range(10), "COUNT")]
    return [change for name in names if look.has(name) for change in not_known(name)]


def _regex(args: list[str], look: Look) -> Sequence[Change]:
    action, expression = args[0], args[1]
    if action == "REPLACE":
        text = "".join(args[4:])
        replaced = _told(args[3], patterns.replaced(expression, args[2], text), expression, args[2], text)
        return [*_last_match_gone(look), *replaced]
    text = "".join(args[3:])
    compiled = patterns.pattern(expression) if is_known(expression + text) else None
    if compiled is None or not patterns.is_cheap(compiled, text):
        return [*_last_match_gone(look), *not_known(args[2])]
    if action == "MATCH":
        return _match(args[2], compiled.search(text))
    found = _all_matches(compiled, expression, text) if action == "MATCHALL" else None
    return [*_last_match_gone(look), *_told(args[2], found)]


def _match(name: str, match: re.Match[str] | None) -> Sequence[Change]:
    left = [Change(each, text) for each, text in patterns.match_variables(match).items()]
    return [*left, Change(name, match[0] if match is not None else "")]


def _all_matches(compiled: re.Pattern[str], expression: str, text: str) -> str | None:
    if "^" in expression.replace("[^", ""):
        return None
    found = [match[0] for match in compiled.finditer(text)]
    return ";".join(found) if all(found) else None


def _hashed(kind: str, args: list[str], look: Look) -> Sequence[Change]:
    """`string(MD5 | SHA... NAME text)`."""
    del look
    name, text = args[0], args[1]
    sum_ = hashlib.new(kind.lower(), text.encode(), usedforsecurity=False).hexdigest()
    return _told(name, None if is_placed(text) else sum_, text)


def _genex(args: list[str], look: Look) -> Sequence[Change]:
    del look
    return _told(args[1], stripped(args[0]), args[0])


_FORMS: Final[dict[str, _Form]] = {
    "TOLOWER": _case(str.lower),
    "TOUPPER": _case(str.upper),
    "STRIP": _case(lambda text: text.strip(" \t\r\n")),
    "APPEND": _append,
    "PREPEND": _prepend,
    "CONCAT": _concat,
    "JOIN": _join,
    "REPLACE": _replace,
    "LENGTH": _length,
    "SUBSTRING": _substring,
    "FIND": _find,
    "REPEAT": _repeat,
    "MAKE_C_IDENTIFIER": _identifier,
    "COMPARE": _compare,
    "CONFIGURE": _configure,
    "REGEX": _regex,
    "GENEX_STRIP": _genex,
    **{kind: partial(_hashed, kind) for kind in _HASHES},
}
