"""Which names a source text calls deprecated."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ecm_extract.entities.deprecations import old_names, warnings_in


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ('"a" was deprecated. Use "b" instead', ["a"]),
        ("Parameter base_frame is deprecated, use robot_base_frame", ["base_frame"]),
        ("deprecated parameter 'old.name', use 'new.name'", ["old.name"]),
        ("this is deprecated", []),
    ],
)
def test_the_old_name_is_told_from_the_new(text: str, names: list[str]) -> None:
    """The name to use instead is not the deprecated one."""
    assert list(old_names(text)) == names


def test_adjacent_literals_are_one_text() -> None:
    """Compilers join them, and names stand in one part with the word in another."""
    source = b'WARN(log(), "\\"a_b\\" was "\n   "deprecated, use c");'
    assert list(warnings_in(source)) == ['"a_b" was deprecated, use c']


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=400))
def test_any_bytes_are_searched(data: bytes) -> None:
    """Content never raises."""
    for text in warnings_in(data + b'"deprecated'):
        assert all(name in text for name in old_names(text))


def test_unclosed_quotes_take_no_time() -> None:
    """A file of quotes is searched in linear time."""
    assert list(warnings_in(b"'\"" * 50_000 + b"deprecated")) is not None
