"""Values of Python expressions."""

import pytest
from ecm_parsers.source.expr import (
    Call,
    Comprehension,
    Constant,
    Expr,
    Items,
    Lambda,
    Member,
    Name,
    Number,
    Op,
    Opaque,
    Table,
    Template,
    Text,
)
from ecm_parsers.source.facts import Function, Statement
from ecm_parsers.source.python import parse_python

A, B, C, X, XS = Name("a"), Name("b"), Name("c"), Name("x"), Name("xs")
NULL = Constant("null")


def module_body(source: str) -> tuple[Statement, ...]:
    functions: tuple[Function, ...] = parse_python(source.encode()).facts.functions
    return functions[0].body


def value_of(source: str) -> Expr | None:
    return module_body(f"v = {source}\n")[-1].value


def call(name: str, *args: Expr) -> Call:
    return Call(Name(name), args, line=1)


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("'x'", Text("x")),
        ('"it\'s"', Text("it's")),
        ("''", Text("")),
        ("''''''", Text("")),
        ('"""a\nb"""', Text("a\nb")),
        ("'''it's'''", Text("it's")),
        (r"'a\tb\\c\x41\u00e9\101\N{BULLET}'", Text("a\tb\\cAéA•")),
        (r"'\N{no such name}\q'", Text(r"\N{no such name}\q")),
        ("'a\\\nb'", Text("ab")),
        (r"'\ud800'", Text("\ufffd")),
        (r"'\U00110000'", Text("\ufffd")),
        (r"r'\d'", Text(r"\d")),
        (r"Rb'\d'", Text(r"\d")),
        ("b'x'", Text("x")),
        ("u'x'", Text("x")),
        ("'a' 'b' \"c\"", Text("abc")),
        ("('a' # why\n 'b')", Text("ab")),
        ("f'a'", Text("a")),
        ("f'{a}/b{{c}}'", Template((A, Text("/b{c}")))),
        ("f'{a!r:>{b}}'", Template((Op("format", (A, Template((Text("!r>"), Name("b"))))),))),
        ("f'{a=}'", Template((Text("a="), A))),
        ("f'{a.b(\"c\")}x' 'y'", Template((Call(Member(A, "b"), (Text("c"),), line=1), Text("xy")))),
        (r"rf'\d{a}'", Template((Text(r"\d"), A))),
    ],
)
def test_string_literal_has_the_value_that_python_gives_it(source: str, expected: Expr) -> None:
    """A string literal of any prefix and quote is its unescaped value."""
    assert value_of(source) == expected


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("1", Number(1)),
        ("-1", Number(-1)),
        ("1_000", Number(1000)),
        ("0x1F", Number(31)),
        ("0o17", Number(15)),
        ("0777", Number(511)),
        ("00", Number(0)),
        ("10L", Number(10)),
        ("1e3", Number(1000.0)),
        (".5", Number(0.5)),
        ("1j", Opaque("1j")),
        ("99999999999999999999", Opaque("99999999999999999999")),
        ("-18446744073709551615", Op("-", (Number(18446744073709551615),))),
        ("True", Constant("true")),
        ("False", Constant("false")),
        ("None", NULL),
        ("...", Opaque("...")),
    ],
)
def test_number_or_constant_is_read_in_every_python_form(source: str, expected: Expr) -> None:
    """Numbers of Python 2 and 3 that fit 64 bit are values, all others are opaque."""
    assert value_of(source) == expected


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("a.b.c", Member(Member(A, "b"), "c")),
        ("a . b", Member(A, "b")),
        ("a().b", Member(call("a"), "b")),
        ("'/'.join(xs)", Call(Member(Text("/"), "join"), (XS,), line=1)),
        ("'{}'.format(a)", Call(Member(Text("{}"), "format"), (A,), line=1)),
        ("'%s/x' % a", Op("%", (Text("%s/x"), A))),
        ("'%s' % (a, b)", Op("%", (Text("%s"), Items((A, B))))),
        ("a + 'x' + b", Op("+", (Op("+", (A, Text("x"))), B))),
        ("x(a, 'b', c=1)", Call(X, (A, Text("b")), (("c", Number(1)),), line=1, keyword_lines=(1,))),
        ("x(*a, **b)", Call(X, (Op("*", (A,)),), (("**", B),), line=1, keyword_lines=(1,))),
        ("a\\\n.b(\n1)", Call(Member(A, "b"), (Number(1),), line=2)),
        ("x(a)(b)", Call(call("x", A), (B,), line=1)),
        ("b if a else c", Op("?:", (A, B, C))),
        ("x(a, \\\n  # why\n  b)", call("x", A, B)),
        ("b if a else \\\n  c", Op("?:", (A, B, C))),
        ("\\\n  a", A),
        ("a[b]", Op("[]", (A, B))),
        ("a[b, c]", Op("[]", (A, Items((B, C))))),
        ("a[1:]", Op("[]", (A, Op(":", (Number(1), NULL))))),
        ("a[::2]", Op("[]", (A, Op(":", (NULL, NULL, Number(2)))))),
        ("[a, 'x']", Items((A, Text("x")))),
        ("(a,)", Items((A,))),
        ("a, b", Items((A, B))),
        ("{a, b}", Call(Name("set"), (Items((A, B)),))),
        ("[]", Items(())),
        ("{'k': a, **b}", Table(((Text("k"), A), (NULL, B)))),
        ("(a)", A),
        ("[*a]", Items((Op("*", (A,)),))),
        ("await a()", call("a")),
        ("yield a", Op("yield", (A,))),
        ("not a", Op("!", (A,))),
        ("a and b or c", Op("||", (Op("&&", (A, B)), C))),
        ("a is not None", Op("!=", (A, NULL))),
        ("a not in b", Op("not in", (A, B))),
        ("a <> b", Op("!=", (A, B))),
        ("a < b <= c", Op("< <=", (A, B, C))),
        ("~a", Op("~", (A,))),
        ("`a`", Opaque("`a`")),
        ("lambda a, *b: c", Lambda(("", ""), ("a", "*b"), C)),
    ],
)
def test_expression_is_written_in_the_common_vocabulary(source: str, expected: Expr) -> None:
    """Operators, calls and displays keep their operands in the order that folding expects."""
    assert value_of(source) == expected


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        (
            "v(lambda a: x(a))",
            (
                Statement("do", 1, call("x", A), deferred=True),
                Statement("do", 1, call("v", Lambda(("",), ("a",), call("x", A)))),
            ),
        ),
        (
            "v = [x(a) for a in xs if b(a)]",
            (
                Statement("each", 1, XS, A),
                Statement("do", 1, call("b", A)),
                Statement("set", 1, Comprehension(call("x", A), (0,), (call("b", A),)), Name("v")),
            ),
        ),
        (
            "v = {a: b for a, b in xs}",
            (
                Statement("each", 1, XS, Items((A, B))),
                Statement("set", 1, Comprehension(Table(((A, B),)), (0,)), Name("v")),
            ),
        ),
        (
            "x(a for a in xs)",
            (Statement("each", 1, XS, A), Statement("do", 1, call("x", Comprehension(A, (0,))))),
        ),
        (
            "if (a := x()): pass",
            (Statement("set", 1, call("x"), A),),
        ),
    ],
)
def test_what_an_expression_binds_or_runs_is_a_statement_before_it(
    source: str, expected: tuple[Statement, ...]
) -> None:
    """Lambda bodies, comprehension loops and walrus bindings precede the statement that holds them."""
    assert tuple(module_body(source))[: len(expected)] == expected
