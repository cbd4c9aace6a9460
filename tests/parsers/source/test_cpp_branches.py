"""Conditional branches that open or close blocks."""

from __future__ import annotations

import time

import pytest
from ecm_parsers.source.cpp import parse_cpp
from ecm_parsers.source.cpp_branches import with_one_branch

SPLIT = [
    b"#if A > 2\nif (a) {\n#else\nif (b) {\n#endif\n",
    b"#ifdef A\nif (a) {\n#elif B\nif (b) {\n#elif C\nif (c) {\n#else\nif (d) {\n#endif\n",
    b'#ifdef A\nif (a == "{") {  // {\n#else\n#if B\nif (b) {\n#endif\n#endif\n',
    b"#ifndef A\nwhile (run('{')) {\n#else\nwhile (run('}')) {\n#endif\n",
]
WHOLE = [
    b"void f() {\n#if A\n  if (a) { g(); }\n#else\n  h();\n#endif\n}\n",
    b'void f() {\n#if A\n  g("{");\n#else\n  h();  // }\n#endif\n}\n',
    b"#if A\n#define OPEN {\n#else\n#define OPEN (\n#endif\n",
    b'#if A\n  g(R"({)");\n#else\n  h(R"m()"{)m");\n#endif\n',
    b"#if A\n  g();  // { \\\n  {\n#else\n  h();\n#endif\n",
]


@pytest.mark.parametrize("text", SPLIT, ids=range(len(SPLIT)))
def test_code_around_a_split_block_is_read(text: bytes) -> None:
    """Of branches that each open a block one is kept, so what follows stays in its function."""
    source = b"void C::first() {\n" + text + b"  inner(1);\n}\nlast(2);\n}\nvoid C::second() { other(3); }\n"
    parsed = parse_cpp(source)
    assert [(f.name, len(f.body)) for f in parsed.facts.functions][-1] == ("second", 1)
    first = parsed.facts.functions[0]
    assert [s.value.callee.id for s in first.body if s.line > text.count(b"\n")] == ["inner", "last"]
    assert parsed.diagnostics == ()


@pytest.mark.parametrize("text", WHOLE, ids=range(len(WHOLE)))
def test_branches_that_are_whole_stay(text: bytes) -> None:
    """Branches whose blocks are closed are both read."""
    assert with_one_branch(text) == text


def test_offsets_stay() -> None:
    """The rewritten text has the same length and lines."""
    for text in SPLIT:
        assert len(with_one_branch(text)) == len(text)
        assert with_one_branch(text).count(b"\n") == text.count(b"\n")


def test_deep_nesting_takes_linear_time() -> None:
    """Many nested branches, comments and strings that never end cost no more than their size."""
    start = time.process_time()
    for text in (b"#if A\n{\n#else\n", b"/*", b'"', b"#if A\n(\n", b"#endif\n", b"'", b"# \\\n"):
        with_one_branch(text * 20_000)
    assert time.process_time() - start < 5


def test_quotes_that_nothing_closes_are_passed_in_one_go() -> None:
    """Many escaped quotes outside of a text cost as much as their length."""
    data = b"#if A\n{\n#endif\nint x = " + b'\\"' * 400_000
    start = time.process_time()
    with_one_branch(data)
    assert time.process_time() - start < 2
