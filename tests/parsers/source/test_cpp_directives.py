"""Where the directives of a file are, and what they say."""

from __future__ import annotations

import time
from itertools import pairwise

import pytest
from ecm_parsers.source.cpp_directives import directives
from hypothesis import given
from hypothesis import strategies as st

PIECES = st.sampled_from(["#if 0", "#", "\n", "\\\n", "//", "/*", "*/", '"', "'", 'R"(', ')"', " ", "x"])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("#define A 1 // one", [("define", "A 1")]),
        ("# define A /* one\n */ 1", [("define", "A   1")]),
        ("#define A \\\n  1", [("define", "A   1")]),
        ('#include "a//b.h"', [("include", '"a//b.h"')]),
        ("#\n#if A\n", [("", ""), ("if", "A")]),
        ("x # y", []),
        ('"\\\n# if"', []),
    ],
)
def test_what_a_directive_says(text: str, said: list[tuple[str, str]]) -> None:
    found = [(each.word.decode(), each.rest.decode()) for each in directives(text.encode())]
    assert [(word, " ".join(rest.split())) for word, rest in found] == [
        (word, " ".join(rest.split())) for word, rest in said
    ]


@given(st.lists(PIECES, max_size=20).map("".join))
def test_each_begins_with_its_sign_and_ends_before_the_next(text: str) -> None:
    data = text.encode()
    found = list(directives(data))
    assert all(data[each.start : each.start + 1] == b"#" for each in found)
    assert [each.start for each in found] == sorted(each.start for each in found)
    assert all(one.end <= other.start for one, other in pairwise(found))


@pytest.mark.parametrize("text", ["/**/", "x/**/", '"', "'", "#", "/", 'R"m(', "\\\n", "#if 0\n", "/* "])
def test_long_files_take_no_longer_than_they_are(text: str) -> None:
    """A file of a million of bytes on one line, or of texts that are never closed."""
    begun = time.monotonic()
    assert all(each.end > each.start for each in directives(text.encode() * 200_000))
    assert time.monotonic() - begun < 20
