"""C++ expressions in the common vocabulary."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp import parse_cpp
from ecm_parsers.source.expr import Call, Constant, Expr, Items, Lambda, Member, Name, Number, Op, Opaque, Text


def value_of(text: str) -> Expr | None:
    """Return the value that `auto x = TEXT;` gives in a function body."""
    body = parse_cpp(f"void f() {{ auto x = {text}; }}".encode()).facts.functions[0].body
    return next(statement.value for statement in body if statement.target == Name("x"))


ROWS: list[tuple[str, Expr]] = [
    ('"plain"', Text("plain")),
    (r'"tab\tquote\""', Text('tab\tquote"')),
    ('R"(raw "text")"', Text('raw "text"')),
    ('"joined " "text"', Text("joined text")),
    ('PREFIX "text"', Op("+", (Name("PREFIX"), Text("text")))),
    ("42u", Number(42)),
    ("0x1F", Number(31)),
    ("1'000", Number(1000)),
    ("-2.5f", Number(-2.5)),
    ("1e-3", Number(0.001)),
    ("true", Constant("true")),
    ("nullptr", Constant("null")),
    ("a::b::C", Name("a::b::C")),
    ("this->member_", Member(Name("this"), "member_")),
    ("(*this).member_", Member(Name("this"), "member_")),
    ("a.b->c", Member(Member(Name("a"), "b"), "c")),
    ("f(1)", Call(Name("f"), (Number(1),), line=1)),
    ("f<int, a::B>()", Call(Name("f"), (), (), ("int", "a::B"), 1)),
    ("n->template get<double>()", Call(Member(Name("n"), "get"), (), (), ("double",), 1)),
    ("std::string{p}", Call(Name("std::string"), (Name("p"),), line=1)),
    ("new pkg::Thing<int>(1)", Call(Name("pkg::Thing"), (Number(1),), (), ("int",), 1)),
    ("std::make_shared<T>(1)", Call(Name("std::make_shared"), (Number(1),), (), ("T",), 1)),
    ("static_cast<double>(v)", Name("v")),
    ("static_cast<double>(10)", Number(10.0)),
    ("static_cast<int>(2.5)", Number(2)),
    ("(double)v", Name("v")),
    ("std::move(v)", Name("v")),
    ("500ms", Call(Name("ms"), (Number(500),), line=1)),
    ('"text"s', Text("text")),
    ("a + b", Op("+", (Name("a"), Name("b")))),
    ("a ? b : c", Op("?:", (Name("a"), Name("b"), Name("c")))),
    ("list[0]", Op("[]", (Name("list"), Number(0)))),
    ("&C::f", Op("&", (Name("C::f"),))),
    ("{1, 2}", Items((Number(1), Number(2)))),
    (
        "std::bind([](const Msg::SharedPtr m) {}, _1)",
        Call(Name("std::bind"), (Lambda(("Msg::SharedPtr",)), Name("_1")), line=1),
    ),
]


@pytest.mark.parametrize(("text", "expected"), ROWS, ids=[row[0] for row in ROWS])
def test_an_expression_reads_as(text: str, expected: Expr) -> None:
    """Each form of expression has one reading."""
    assert value_of(text) == expected


def test_what_means_nothing_here_is_opaque() -> None:
    """Unknown expressions keep their text, cut."""
    assert value_of("sizeof(int)") == Opaque("sizeof(int)")


def test_the_line_of_a_call_is_that_of_its_name() -> None:
    """In a chain over several lines each call has the line where its own name stands."""
    body = parse_cpp(b"void f() {\n  node->make()\n    .second(1);\n}").facts.functions[0].body
    outer = body[0].value
    assert isinstance(outer, Call)
    assert isinstance(outer.callee, Member)
    inner = outer.callee.base
    assert isinstance(inner, Call)
    assert (inner.line, outer.line) == (2, 3)


def test_endless_nesting_is_cut() -> None:
    """Ten thousand operators deep is opaque beyond a bound, and costs no stack."""
    facts = parse_cpp(("void f() { auto x = " + "(" * 10_000 + "1" + ")" * 10_000 + "; }").encode()).facts
    assert facts.language == "cpp"
