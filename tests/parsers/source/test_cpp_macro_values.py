"""What a `#define` stands for."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp_macro_values import MAX_LENGTH, macro_value
from ecm_parsers.source.expr import Expr, Name, Number, Op, Text

VALUES: list[tuple[str, Expr | None]] = [
    ('"odom"', Text("odom")),
    ("20", Number(20)),
    ("other::name", Name("other::name")),
    ('PREFIX "/port"', Op("+", (Name("PREFIX"), Text("/port")))),
    ("PREFIX NAME", Op("+", (Name("PREFIX"), Text(""), Name("NAME")))),
    ('PREFIX NAME "/a"', Op("+", (Name("PREFIX"), Text(""), Name("NAME"), Text(""), Text("/a")))),
    ('"odom"   // where it is, of "old" ones too', Text("odom")),
    ('"http://here"', Text("http://here")),
    ("/* first */ 20 // then", Number(20)),
    ("PREFIX NAME // both", Op("+", (Name("PREFIX"), Text(""), Name("NAME")))),
    (f"20 // {'a' * MAX_LENGTH}", Number(20)),
    ("// nothing", None),
    ("do { run(); } while (0)", None),
    ("public: void run();", None),
    ("", None),
    (f'"{"a" * MAX_LENGTH}"', None),
]


@pytest.mark.parametrize(("text", "expected"), VALUES, ids=[row[0][:24] for row in VALUES])
def test_values(text: str, expected: Expr | None) -> None:
    """Texts, numbers, names and macros side by side are values, whatever comment follows; code is none."""
    assert macro_value(text.encode()) == expected
