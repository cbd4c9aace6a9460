"""Predicates of contracts, read and compared by implication. Nothing is ever evaluated as code.

Forms: `base_ready`, `not base_ready`, `gripper.is_open`, `localization_confidence >= 0.90`, `dist < 1 m`,
`pose.frame == base_link`, `mode != manual`. A text of another form is one atom: true or not known.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from typing import Final, Literal

import msgspec

from ecm_checker.units import quantity

Verdict = Literal["implied", "contradicted", "unknown"]
Scalar = float | str | bool

_COMPARISON: Final = re.compile(r"\s*([A-Za-z_][\w./@-]*)\s*(==|=|!=|<=|>=|<|>)\s*(\S[^<>=!]*)")
_NEGATION: Final = re.compile(r"\s*(?:not\s+|!\s*)([A-Za-z_][\w./@-]*)\s*")
_WORDS: Final[Mapping[str, bool]] = {"true": True, "false": False}
_LONGEST: Final = 300


class Predicate(msgspec.Struct, frozen=True):
    """`subject op value`; numbers are in SI units.

    Attributes:
        text: as written.
        subject: what it speaks of.
        op: one of `== != < <= > >=`.
        value: number, word or truth value.
        dimension: physical dimension of a number; empty when it has no unit.
    """

    text: str
    subject: str
    op: str
    value: Scalar
    dimension: str = ""


class _Range(msgspec.Struct, frozen=True):
    """An interval of numbers."""

    low: float = -math.inf
    high: float = math.inf
    low_open: bool = False
    high_open: bool = False


def parse(text: str) -> Predicate:
    """Read a predicate; never fails."""
    short = text.strip()[:_LONGEST]
    compared = _COMPARISON.fullmatch(short)
    if compared is not None:
        return _comparison(short, compared[1], "==" if compared[2] == "=" else compared[2], compared[3].strip())
    negated = _NEGATION.fullmatch(short)
    if negated is not None:
        return Predicate(short, negated[1], "==", False)
    return Predicate(short, short, "==", True)


def fact(name: str, value: object) -> Predicate:
    """What is known of a state: `name == value`."""
    if isinstance(value, bool):
        return Predicate(f"{name} == {str(value).lower()}", name, "==", value)
    return _comparison(f"{name} == {value}", name, "==", str(value))


def implies(known: Predicate, wanted: Predicate) -> Verdict:
    """Whether what is known settles what is wanted."""
    if known.subject != wanted.subject:
        return "unknown"
    if isinstance(known.value, float) and isinstance(wanted.value, float):
        return _compare_numbers(known, wanted)
    if type(known.value) is not type(wanted.value):
        return "unknown"
    return _compare_words(known, wanted)


def settle(known: Iterable[Predicate], wanted: Predicate) -> Verdict:
    """Whether any of what is known settles it; a contradiction weighs more than a support."""
    verdicts = {implies(each, wanted) for each in known}
    if "contradicted" in verdicts:
        return "contradicted"
    return "implied" if "implied" in verdicts else "unknown"


def _comparison(text: str, subject: str, op: str, value: str) -> Predicate:
    word = value.strip("'\"")
    if word.lower() in _WORDS:
        truth = _WORDS[word.lower()]
        return Predicate(text, subject, "==", truth if op == "==" else not truth)
    number = quantity(word)
    if number is not None:
        return Predicate(text, subject, op, number.value, number.dimension)
    return Predicate(text, subject, op, word)


def _compare_words(known: Predicate, wanted: Predicate) -> Verdict:
    same = known.value == wanted.value
    if isinstance(known.value, bool):
        return "implied" if same else "contradicted"
    if same and known.op == wanted.op:
        return "implied"
    if known.op == wanted.op == "==":
        return "contradicted"
    if known.op == "==" and wanted.op == "!=":
        return "contradicted" if same else "implied"
    if known.op == "!=":
        return _compare_exclusion(wanted, same)
    return "unknown"


def _compare_exclusion(wanted: Predicate, same: bool) -> Verdict:
    if not same:
        return "unknown"
    return "implied" if wanted.op == "!=" else "contradicted" if wanted.op == "==" else "unknown"


def _compare_numbers(known: Predicate, wanted: Predicate) -> Verdict:
    if known.dimension and wanted.dimension and known.dimension != wanted.dimension:
        return "unknown"
    if known.op == "!=":
        return _compare_exclusion(wanted, known.value == wanted.value)
    inner = _range(known)
    if wanted.op == "!=":
        inside = _overlap(inner, _range(msgspec.structs.replace(wanted, op="==")))
        alone = inner.low == inner.high
        return "implied" if not inside else "contradicted" if alone else "unknown"
    outer = _range(wanted)
    if not _overlap(inner, outer):
        return "contradicted"
    return "implied" if _within(inner, outer) else "unknown"


def _range(predicate: Predicate) -> _Range:
    value = predicate.value
    assert isinstance(value, float)
    if predicate.op in {"<", "<="}:
        return _Range(high=value, high_open=predicate.op == "<")
    if predicate.op in {">", ">="}:
        return _Range(low=value, low_open=predicate.op == ">")
    return _Range(value, value)


def _within(inner: _Range, outer: _Range) -> bool:
    low = inner.low > outer.low or (inner.low == outer.low and (inner.low_open or not outer.low_open))
    high = inner.high < outer.high or (inner.high == outer.high and (inner.high_open or not outer.high_open))
    return low and high


def _overlap(one: _Range, two: _Range) -> bool:
    return not (_below(one, two) or _below(two, one))


def _below(one: _Range, two: _Range) -> bool:
    return one.high < two.low or (one.high == two.low and (one.high_open or two.low_open))
