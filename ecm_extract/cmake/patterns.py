r"""Regular expressions of CMake (cmake-string(7), "Regex Specification") as those of Python.

CMake has neither `\d` nor `{n}` nor lazy quantifiers. What could take long to match is not matched at all.
"""

from __future__ import annotations

import re
from functools import cache
from typing import Final

_LIMITS: Final = ((2, 4_000), (4, 300), (8, 60))
"""How many quantifiers a pattern may have for texts of which length: matching goes back and forth."""
_NESTED: Final = re.compile(r"[*+?][^()]*\)[*+]")
_QUANTIFIER: Final = frozenset("*+?")
_GROUPS: Final = 10
MATCH: Final = "CMAKE_MATCH_"
"""How the variables are called that hold the last match."""


@cache
def pattern(text: str) -> re.Pattern[str] | None:
    """Return the pattern, or None for one that CMake refuses or that this does not know."""
    if len(text) > 400 or _NESTED.search(text):
        return None
    try:
        return re.compile(_translated(text), re.DOTALL)
    except (re.error, IndexError, OverflowError):
        return None


def match_variables(match: re.Match[str] | None) -> dict[str, str]:
    """Return what a match leaves in CMAKE_MATCH_0 and so on; without one these are empty."""
    texts = (match[0], *match.groups()) if match is not None else ()
    found = dict.fromkeys((f"{MATCH}{at}" for at in range(_GROUPS)), "")
    found |= {f"{MATCH}{at}": text or "" for at, text in enumerate(texts[:_GROUPS])}
    last = max((at for at, text in enumerate(texts) if text is not None), default=0)
    return {**found, f"{MATCH}COUNT": str(last)}


def is_cheap(expression: re.Pattern[str], text: str) -> bool:
    """Tell whether a match ends soon."""
    count = sum(char in _QUANTIFIER for char in expression.pattern)
    return len(text) <= next((limit for most, limit in _LIMITS if count <= most), 0)


def _translated(text: str) -> str:
    found, at = [], 0
    while at < len(text):
        char = text[at]
        if char == "\\":
            found.append(re.escape(text[at + 1]))
            at += 2
        elif char == "[":
            end = _end_of_set(text, at)
            found.append(_set(text[at + 1 : end]))
            at = end + 1
        elif char == "(":
            # A `(?` would be Python's; in CMake it is an error.
            if text[at + 1 : at + 2] == "?":
                message = "no such group"
                raise re.error(message)
            found.append(char)
            at += 1
        else:
            if char in _QUANTIFIER and text[at + 1 : at + 2] in _QUANTIFIER and text[at + 1 : at + 2]:
                message = "nested quantifier"
                raise re.error(message)
            found.append({"$": r"\Z", "{": r"\{", "}": r"\}"}.get(char, char))
            at += 1
    return "".join(found)


def _end_of_set(text: str, at: int) -> int:
    """Position of the `]` that ends a set; one right after `[` or `[^` is a member."""
    start = at + 2 if text[at + 1] == "^" else at + 1
    return text.index("]", start + 1) if "]" in text[start + 1 :] else len(text)


def _set(inside: str) -> str:
    """A set of characters: a backslash in it is a character."""
    escaped = inside.replace("\\", r"\\").replace("[", r"\[")
    head, rest = ("^", escaped[1:]) if escaped.startswith("^") else ("", escaped)
    rest = r"\]" + rest[1:] if rest.startswith("]") else rest
    return f"[{head}{rest.replace('&&', '&').replace('--', '-').replace('~~', '~').replace('||', '|')}]"


def replacement(text: str) -> str | None:
    r"""Return what `\1` .. `\9` and `\0` mean to Python; None for an escape that CMake refuses."""
    found, at = [], 0
    while at < len(text):
        if text[at] != "\\":
            found.append(text[at])
            at += 1
            continue
        following = text[at + 1 : at + 2]
        if following.isdigit():
            found.append(rf"\g<{following}>")
        elif following == "\\":
            found.append(r"\\")
        elif following == "n":
            found.append("\n")
        else:
            return None
        at += 2
    return "".join(found)


def replaced(expression: str, new: str, text: str) -> str | None:
    """`string(REGEX REPLACE ...)`; None when it is not known."""
    compiled, put = pattern(expression), replacement(new)
    if compiled is None or put is None or not is_cheap(compiled, text) or _is_anchored(expression):
        return _replaced_once(expression, put, text) if put is not None else None
    try:
        return compiled.sub(put, text)
    except (re.error, IndexError):
        return None


def _replaced_once(expression: str, put: str, text: str) -> str | None:
    """A pattern that starts with `^` matches at the start, and in old CMake again after each match (CMP0186)."""
    compiled = pattern(expression)
    if compiled is None or not is_cheap(compiled, text) or not expression.startswith("^"):
        return None
    match = compiled.match(text)
    if match is None:
        return text
    if not match[0] or compiled.match(text, match.end()) or compiled.match(text[match.end() :]):
        return None
    try:
        return match.expand(put) + text[match.end() :]
    except (re.error, IndexError):
        return None


def _is_anchored(expression: str) -> bool:
    return "^" in expression.replace("[^", "")
