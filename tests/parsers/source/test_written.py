"""What counts as a name and as a text of a source, beside its comments."""

from __future__ import annotations

import time

import pytest
from ecm_parsers.source import cpp_written, python_written
from ecm_parsers.source.cpp_directives import included
from hypothesis import given
from hypothesis import strategies as st

PIECES = st.sampled_from(["#if 0", "#", "\n", "\\\n", "//", "/*", "*/", '"', "'", 'R"(', ')"', " ", "x", "é"])


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('f("a"); // "b"', [("a", 1)]),
        ('/* "a"\n*/ f("b")', [("b", 2)]),
        ('"a" /* c */\n  "b"', [("ab", 1)]),
        ('"a" x "b"', [("a", 1), ("b", 1)]),
        ('"a"PRI"b"', [("a", 1), ("b", 1)]),
        ('u8"a", L"b", R"m(c"d)m"', [("a", 1), ("b", 1), ('c"d', 1)]),
        (r'"a\"b"', [('a"b', 1)]),
        ("'a' 1'000 'b'", []),
        ('#include "a"\n#define B "b"', [("b", 2)]),
        ('"open\nf("b")', [("open", 1), ("b", 2)]),
    ],
)
def test_texts_of_cpp(code: str, expected: list[tuple[str, int]]) -> None:
    """A text is what a compiler takes for one."""
    assert [(each.value, each.line) for each in cpp_written.texts(code.encode())] == expected


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('"""doc"""\nf("a")  # "b"', [("a", 2)]),
        ('def f():\n    "doc"\n    return "a" "b"', [("ab", 3)]),
        ("print 'a'", [("a", 1)]),
        ('f("a{x}")', [("a{x}", 1)]),
        ("x = {'a': r'b'}", [("a", 1), ("b", 1)]),
    ],
)
def test_texts_of_python(code: str, expected: list[tuple[str, int]]) -> None:
    """A text that nothing takes is no text of the program."""
    assert [(each.value, each.line) for each in python_written.texts(code.encode())] == expected


def test_names_are_neither_comments_nor_texts() -> None:
    """What a comment or a text says is no name."""
    cpp = cpp_written.names(b'a::b<c> d(0x1f, "e"); // f\n/* g */ h')
    python = python_written.names(b"import a.b\nc = 'd'  # e\n")
    assert [(each.value, each.line) for each in cpp] == [("a", 1), ("b", 1), ("c", 1), ("d", 1), ("h", 2)]
    assert [each.value for each in python] == ["a", "b", "c"]


def test_what_is_included() -> None:
    """A comment includes nothing, and a macro no path that is known."""
    code = b'#include <a/b.h> // x\n# include "c.h"\n/*\n#include <d.h>\n*/\n#include MADE\n#include_next <e.h>\n'
    assert list(included(code)) == ["a/b.h", "c.h", "e.h"]


@given(st.lists(PIECES, max_size=20).map("".join))
def test_any_bytes_are_read(text: str) -> None:
    """Lines only grow, whatever a file holds."""
    for read in (cpp_written.texts, cpp_written.names, python_written.texts, python_written.names):
        lines = [each.line for each in read(text.encode())]
        assert lines == sorted(lines)


@pytest.mark.parametrize("text", ["/**/", '"', '"a" ', "'", "1'", "x ", 'R"m(', "\\\n", "/* "])
def test_long_files_take_no_longer_than_they_are(text: str) -> None:
    """A file of a million of bytes on one line, or of texts that are never closed."""
    begun = time.monotonic()
    assert all(each.line for each in (*cpp_written.texts(text.encode() * 200_000),))
    assert time.monotonic() - begun < 20
