"""What is left of a file without the code that no build compiles."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp_dead import without_dead
from hypothesis import given
from hypothesis import strategies as st

LINES = st.sampled_from(
    ["#if 0", "#if 1", "#ifdef A", "#ifndef A", "#elif B", "#elif 0", "#else", "#endif", "#undef A", "#define A", "x;"]
)

KEPT = {
    "the other side": ("#if 0\na;\n#else\nb;\n#endif", "b;"),
    "one side": ("#if 1\na;\n#else\nb;\n#endif", "a;"),
    "nothing": ("#if 0 // old\na;\n#endif\nb;", "b;"),
    "nested": ("#if 0\n#ifdef A\na;\n#endif\n#endif\nb;", "b;"),
    "not": ("#undef A\n#if !A\na;\n#else\nb;\n#endif", "#undef A a;"),
    "undefined": ("#undef A\n#ifdef A\na;\n#endif\n#ifndef A\nb;\n#endif", "#undef A b;"),
    "undefined, as a value": ("#undef A\n#if A\na;\n#endif\n#if defined(A)\nb;\n#endif", "#undef A"),
    "a chain that ends": ("#if 0\na;\n#elif 1\nb;\n#else\nc;\n#endif", "b;"),
    "a chain of the build": ("#if 0\na;\n#elif B\nb;\n#else\nc;\n#endif", "#if 0 #elif B b; #else c; #endif"),
    "behind what the build decides": ("#ifdef B\na;\n#elif 0\nb;\n#endif", "#ifdef B a; #elif 0 #endif"),
    "defined again": ("#undef A\n#define A\n#ifdef A\na;\n#endif", None),
    "perhaps defined again": ("#undef A\n#ifdef B\n#define A 1\n#endif\n#ifdef A\na;\n#endif", None),
    "a header may define it": ("#undef A\n#include <b.h>\n#ifdef A\na;\n#endif", None),
    "perhaps undefined": ("#ifdef B\n#undef A\n#endif\n#ifdef A\na;\n#endif", None),
    "a number of something": ("#if 0 + B\na;\n#endif", None),
    "a text": ('x = "\\\n#if 0\\\n"; a; /*\n#if 0\n*/ b;', None),
    "a raw text": ('x = R"(\n#if 0\n)"; a;\n#if 1\nb;\n#endif', 'x = R"(\n#if 0\n)"; a; b;'),
    "a raw text with a mark": ('x = LR"m(\n#if 0\n)"\n#endif\n)m"; a;', None),
    "no raw text": ('x = FOR"(\n";\n#if 0\na;\n#endif\nb;', 'x = FOR"(\n"; b;'),
    "a raw text that is never closed": ('#if 0\nx = R"(\n#endif\na;', None),
    "a comment that goes on": ("// so \\\n#if 0\na;\n// \\\n#endif\nb;", None),
    "a comment behind a directive": ("#if 0 /* old\n#endif */\na;\n#endif\nb;", "b;"),
    "a comment before a directive": ("/* old */ #if 0\na;\n/*\n*/ #endif\nb;", "/* old */ b;"),
    "code before a sign": ("x /* \n */ #if 0\na;\n#endif", None),
    "a continued line": ("#define A(x) x \\\n#if 0\na;\n", None),
    "a line continued as on Windows": ("#define A(x) x \\\r\n#if 0\r\na;\r\n", None),
    "a directive of several lines": ("#if \\\n0\na;\n#endif\nb;", "b;"),
    "much space": ("#  if \t 0\na;\n#endif\nb;", "b;"),
    "an apostrophe in what is not compiled": ("#if 0\nI don't \" know\n#endif\nb;", "b;"),
    "an apostrophe in a number": ("int x = 1'000;\n#if 0\na;\n#endif", "int x = 1'000;"),
    "never closed": ("#if 1\na;\n", None),
    "undefined where it is compiled": ("#if 1\n#undef A\n#ifdef A\na;\n#endif\n#endif\n", "#undef A"),
    "defined where it is not": ("#undef A\n#if 0\n#define A\n#endif\n#ifdef A\na;\n#endif\n", "#undef A"),
}


@pytest.mark.parametrize("name", KEPT)
def test_only_what_is_compiled_is_left(name: str) -> None:
    text, kept = KEPT[name]
    found = without_dead(text.encode()).decode()
    assert found.split() == (text if kept is None else kept).split()


@given(st.lists(LINES, max_size=12))
def test_offsets_and_lines_stay(lines: list[str]) -> None:
    text = "\n".join(lines).encode()
    found = without_dead(text)
    assert len(found) == len(text)
    assert found.count(b"\n") == text.count(b"\n")
    assert without_dead(found) == found
