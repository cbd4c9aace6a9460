"""Numbers as texts spell them."""

from __future__ import annotations

import math

import pytest
from ecm_parsers.numbers import INT_MAX, INT_MIN, integer, real, truncated
from hypothesis import given
from hypothesis import strategies as st


@given(st.integers(INT_MIN, INT_MAX))
def test_each_integer_of_64_bit_is_read(value: int) -> None:
    """What a type holds is read, in each base."""
    assert integer(str(value)) == integer(hex(value), 0) == value


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_each_double_is_read(value: float) -> None:
    """What a double holds is read."""
    assert real(repr(value)) == value


@pytest.mark.parametrize("text", ["", "x", "²", "1" * 5000, str(INT_MAX + 1), str(INT_MIN - 1)])
def test_other_texts_are_no_integer(text: str) -> None:
    """No exception, no number that facts cannot carry."""
    assert integer(text) is None


@pytest.mark.parametrize("text", ["", "x", "1e999", "inf", "nan", "1" * 5000])
def test_other_texts_are_no_double(text: str) -> None:
    """Infinity is no number of a robot."""
    assert real(text) is None


@pytest.mark.parametrize(("value", "whole"), [(1.9, 1), (-1.9, -1), (1e30, None), (math.inf, None), (math.nan, None)])
def test_what_no_integer_holds_is_not_truncated(value: float, whole: int | None) -> None:
    """A cast has a value only where a type has it."""
    assert truncated(value) == whole
