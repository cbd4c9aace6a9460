"""C++ that costs more than its size, if it is read without care."""

from __future__ import annotations

import time

import pytest
from ecm_parsers.source.cpp import parse_cpp
from ecm_parsers.source.cpp_text import without_macros

NEVER_ENDED = [b"/* ", b'R"(', b"a(", b'"a ', b"'a", b'N(x) "']


@pytest.mark.parametrize("text", NEVER_ENDED)
def test_what_nobody_ends_is_passed_in_one_go(text: bytes) -> None:
    """Comments, texts and calls that never end cost as much as their length."""
    start = time.process_time()
    without_macros(text * 200_000)
    assert time.process_time() - start < 5


def test_many_variables_of_loops_take_linear_time() -> None:
    """Whether what a loop declares is named behind it is looked up, not searched again for each."""
    loops = b"".join(b"for (int a%d = 0; a%d < 3; ++a%d) {}\n" % (at, at, at) for at in range(8_000))
    start = time.process_time()
    parse_cpp(b"void f() {\n" + loops + b"}\n")
    assert time.process_time() - start < 5
