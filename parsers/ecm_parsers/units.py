"""The unit that a comment names, as a short symbol (`m/s`, `rad`, `deg`).

Conservative: a unit counts only where people put units (brackets, `in metres`, `unit: m`, a comment that is
nothing else), and a comment that names two different units names none.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from importlib.resources import files

import msgspec

_MAX_COMMENT = 2_000
_BRACKETED = re.compile(r"[\[(<]\s*([^\[\]()<>]{1,40}?)\s*[\])>]")
_STATED = re.compile(r"\bunits?\s*(?::|=|is|are|in)\s+(?=([^\n,;]{1,60}))", re.IGNORECASE)
_IN = re.compile(r"\bin\s+(?=([^\n,;:()\[\]]{1,60}))")
_LEADING = re.compile(r"([^\s\[(:;,]{2,20}?)(?:\s*[\[(:;,]|\t|\s+\d)")
_SCALE = re.compile(r"[*×x]$|[*×x]?\s*\d")
_SQUARED = re.compile(r"\s+squared\b|\s*\*\*\s*2\b|²")
_CUBED = re.compile(r"\s+cubed\b|\s*\*\*\s*3\b|³")
_QUOTIENT = re.compile(r"\s*/\s*|\s+per\s+")
_POWER = re.compile(r"(.+?)\^?([23])")
_PHRASE_WORDS = 4


class _Table(msgspec.Struct, frozen=True):
    """Spelling -> short unit; `weak` spellings are units only where nothing follows."""

    symbols: Mapping[str, str]
    words: Mapping[str, str]
    weak: frozenset[str]


def unit_of(comment: str) -> str | None:
    """Return the one unit that a comment names, or None for none or several.

    Args:
        comment: its text without `#`; only the first 2000 characters are looked at.
    """
    units = set(_units(comment[:_MAX_COMMENT]))
    return units.pop() if len(units) == 1 else None


def normalize(text: str) -> str | None:
    """Return the short unit of a spelling (`metres per second squared` -> `m/s^2`), or None."""
    text = _CUBED.sub("^3", _SQUARED.sub("^2", text.strip()))
    if text in _table().symbols:
        return _table().symbols[text]
    factors = [_factor(part) for part in _QUOTIENT.split(text, maxsplit=3)]
    known = [factor for factor in factors if factor is not None]
    if len(known) < len(factors):
        return None
    if len(known) == 3 and known[1] == known[2]:
        return f"{known[0]}/{known[1]}^2"
    return "/".join(known)


@cache
def _table() -> _Table:
    raw = tomllib.loads(files("ecm_parsers").joinpath("units.toml").read_text(encoding="utf-8"))
    words = {word: unit for unit, spellings in raw["words"].items() for word in spellings}
    return _Table(
        symbols={symbol: unit for unit, spellings in raw["symbols"].items() for symbol in spellings},
        words={**words, **{f"{word}s": unit for word, unit in words.items()}},
        weak=frozenset(raw["weak"]["words"]),
    )


def _factor(text: str) -> str | None:
    """Resolve one side of a quotient: a spelling, or one with a power."""
    table = _table()
    unit = table.symbols.get(text) or table.words.get(text.lower())
    if unit is not None:
        return unit
    power = _POWER.fullmatch(text)
    base = table.symbols.get(power[1]) or table.words.get(power[1].lower()) if power else None
    return f"{base}^{power[2]}" if power and base else None


def _units(comment: str) -> Iterator[str]:
    for candidate in _BRACKETED.findall(comment):
        yield from _known(candidate)
    for phrase in (*_STATED.findall(comment), *_IN.findall(comment)):
        yield from _leading_unit(phrase)
    for line in comment.split("\n"):
        yield from _line_units(line)


def _line_units(line: str) -> Iterator[str]:
    """Yield what a line is as a whole, what it starts with before a mark, and what it ends with."""
    bare = line.strip(". ")
    yield from _known(bare)
    tail = bare.rpartition(",")[2].strip()
    if len(tail) > 1:
        yield from _known(tail)
    last = bare.rpartition(" ")[2]
    if "/" in last:
        yield from _known(last)
    leading = _LEADING.match(line)
    if leading and leading[1].lower() not in _table().weak:
        yield from _known(leading[1])


def _known(text: str) -> Iterator[str]:
    unit = normalize(text)
    if unit is not None:
        yield unit


def _leading_unit(phrase: str) -> Iterator[str]:
    """Yield the unit that the phrase begins with, the longest first: `metres per second from the base`."""
    words = phrase.split()
    for count in range(min(_PHRASE_WORDS, len(words)), 0, -1):
        text = " ".join(words[:count])
        bare = text.rstrip(".!?")
        unit = normalize(bare)
        if unit is None:
            continue
        if count < len(words) and _SCALE.match(words[count]):
            return
        ends = count == len(words) or bare != text
        if ends or (len(bare) > 1 and bare.lower() not in _table().weak):
            yield unit
        return
