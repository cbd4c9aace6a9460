"""Conditionals of a file with an error somewhere: only those that the error is about are read as none."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp import parse_cpp
from ecm_parsers.source.cpp_conditionals import without_conditionals
from ecm_parsers.source.expr import Opaque
from ecm_parsers.source.flow import Branch

TORN = """
void names() {
  add("a");
#ifdef FAST
  add("b");
#endif
}
void text() {
  say("one "
#ifdef FAST
    "two "
#endif
    "three");
}
"""
GUARDED = f"#ifndef NAMES_H\n#define NAMES_H\n{TORN}\n#endif\n"


@pytest.mark.parametrize("source", [TORN, GUARDED])
def test_a_branch_stays_one_beside_a_text_that_directives_tear(source: str) -> None:
    """What `#ifdef` adds in another function was told as what each build has."""
    functions = {each.name: each for each in parse_cpp(source.encode()).facts.functions}
    assert [step.test for step in functions["names"].flow if isinstance(step, Branch)] == [Opaque("#if FAST")]
    assert len(functions["text"].body) == 1


def test_directives_that_no_error_has_in_it_stay() -> None:
    data = b"#if A\nint a;\n#if B\nint b;\n#else\nint c;\n#endif\n#endif\n"
    at = data.index(b"#else")
    assert without_conditionals(data, [(at, at + 1)]) == data.replace(b"#if B", b"     ").replace(
        b"#else", b"     "
    ).replace(b"int c;\n#endif", b"int c;\n      ")
    assert b"#" not in without_conditionals(data)
