from __future__ import annotations

import ast
import math
import time
from typing import Any

import pytest
from ecm_parsers.expression import Budget, ExpressionError, UnknownNameError, evaluate
from hypothesis import given, settings
from hypothesis import strategies as st

NAMES: dict[str, Any] = {"x": 2, "side": "left", "ns.width": 0.5, "cfg": {"wheels": ["a", "b"], "radius": 0.1}}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 + 2*3", 7),
        ("x ** 2 - 1", 3),
        ("2 ** -1", 0.5),
        ("7 // 2 % 2", 1),
        ("-pi/2", -math.pi / 2),
        ("math.radians(180)", math.pi),
        ("hypot(3, 4)", 5.0),
        ("round(2.345, 1)", 2.3),
        ("side == 'left' and x < 3", True),
        ("not x or side", "left"),
        ("1 if side == 'right' else -1", -1),
        ("ns.width * 2", 1.0),
        ("cfg['wheels'][0] + cfg.wheels[-1]", "ab"),
        ("cfg.get('radius', 1)", 0.1),
        ("cfg.get('none', {'a': 1})", {"a": 1}),
        ("'a' in cfg['wheels']", True),
        ("(1, 2) + (3,)", (1, 2, 3)),
        ("side.upper() + '_'.join(['a', 'b'])", "LEFTa_b"),
        ("'{}_{n}'.format(side, n=x)", "left_2"),
        ("f'{side}_joint'", "left_joint"),
        ("[i * 2 for i in range(3) if i]", [2, 4]),
        ("sorted(dict(b=1, a=2).keys())", ["a", "b"]),
        ("max(1, 2.5) + len('abc')", 5.5),
        ("xacro.x", 2),
        (" 1\n", 1),
        ("round(2.5)", 2),
        ("str(round(2.5))", "2"),
        ("tau / 2", math.pi),
        ("str(pow(2, 3))", "8.0"),
        ("divmod(7, 2)", (3, 1)),
        ("[a + b for a, b in zip('ab', 'cd')]", ["ac", "bd"]),
        ("[k + str(v[0]) for k, v in {'a': [1], 'b': [2]}.items()]", ["a1", "b2"]),
        ("[i + j for i, (_, j) in enumerate([(1, 2), (3, 4)], 1)]", [3, 6]),
        ("[last for first, *last in [[1, 2, 3]]]", [[2, 3]]),
        ("[(i, j) for i in range(3) for j in range(i) if j != i - 1]", [(2, 0)]),
        ("{k: v * x for k, v in dict(a=1).items()}", {"a": 2}),
        ("sum(i for i in (1, 2))", 3),
        ("sorted({i % 2 for i in range(5)})", [0, 1]),
        ("{1, 2} == {2, 1} and {1} | {2} == {1, 2} and {1, 2} & {2, 3} == {2} and {1} ^ {2} == {1, 2}", True),
        ("{1} <= {1, 2} and not {1} > {1, 2}", True),
        ("(lambda a, b=2, *more: a + b + len(more))(1, 3, 4, 5)", 6),
        ("[(lambda n: n * i)(2) for i in range(2)]", [0, 2]),
        ("sorted(['bb', 'a'], key=lambda word: len(word))", ["a", "bb"]),
        ("sorted(['bb', 'a'], key=len)", ["a", "bb"]),
        ("max([1, -3], key=lambda n: n * n)", -3),
        ("list(map(lambda n: n + x, [1, 2])) + list(map(str, [1]))", [3, 4, "1"]),
        ("list(filter(lambda n: n > 1, [1, 2]))", [2]),
        ("list(reversed([1, 2]))[::-1]", [1, 2]),
        ("'abcd'[1:-1] + 'abcd'[::-2]", "bcdb"),
        ("{**{'a': 1}, 'b': 2}", {"a": 1, "b": 2}),
        ("[*[1, 2], 3] + list((*'ab',))", [1, 2, 3, "a", "b"]),
        ("max(*[1, 2])", 2),
        ("'{a}'.format(**{'a': 1})", "1"),
        ("'%s_%02d%%' % (side, 3)", "left_03%"),
        ("'%(a)s' % {'a': 1}", "1"),
        ("f'{x:02d}{side!r:>8}'", "02  'left'"),
        ("'{:+.2f}|{:*^5}'.format(1.0, 'a')", "+1.00|**a**"),
        ("'a,b'.split(sep=',')", ["a", "b"]),
        ("'7'.zfill(3) + 'a'.center(3)", "007 a "),
        ("type([]) == list and type({1}) is set and type('') != list", True),
        ("5 & 3 | 8 ^ 1 << 2", 13),
        ("~x", -3),
        ("1 < x <= 2 and x is not None", True),
    ],
)
def test_the_subset_means_what_python_means(text: str, value: object) -> None:
    """Expressions of xacro and launch have the value that Python gives them."""
    assert evaluate(text, NAMES) == value


@pytest.mark.parametrize("text", ["missing + 1", "cfg.missing", "undefined(1)", "ns.height"])
def test_an_unknown_name_is_told_apart(text: str) -> None:
    """A value that is known only elsewhere is no mistake of the expression."""
    with pytest.raises(UnknownNameError):
        evaluate(text, NAMES)


@pytest.mark.parametrize(
    "text",
    [
        "1/0",
        "",
        "1 +",
        "'a' + 1",
        "int('x')",
        "cfg['none']",
        "(lambda: 1)(2)",
        "(lambda a: a)()",
        "(lambda *, a: a)(a=1)",
        "len",
        "str",
        "x(1)",
        "[0 for cfg['a'] in [1]]",
        "[a for a, b in [(1, 2, 3)]]",
        "'%*d' % (9999999, 1)",
        "cfg.update(a=1)",
        "cfg.wheels.append('c')",
        "().__class__",
        "side.__class__.__mro__",
        "__import__('os')",
        "open('/etc/passwd')",
        "'{0.__class__}'.format(x)",
        "'{:9999999999}'.format(x)",
        "'%999999999d' % 1",
        "f'{x:{x}999999999}'",
        "b'a'",
        "1j",
        "(-8.0) ** 0.5",
        "x := 3",
        "*x",
    ],
)
def test_what_is_wrong_or_not_allowed_is_refused(text: str) -> None:
    """Nothing outside the whitelist is evaluated, least of all attributes of objects and calls."""
    with pytest.raises(ExpressionError):
        evaluate(text, NAMES)


@pytest.mark.parametrize(
    "text",
    [
        "'a' * 10**9",
        "10 ** 10 ** 10",
        "1 << 10**9",
        "factorial(10**7)",
        "'a'.center(10**9)",
        "'%9999999d' % 1",
        "(lambda f: f(f))(lambda f: f(f))",
        "(lambda f: f(f))(lambda f: f(f) + f(f))",
        "[0 for a in range(9999) for b in range(9999)]",
        "{a: [b for b in range(9999)] for a in range(9999)}",
        "list(map(lambda n: list(range(9999)), range(9999)))",
        "sorted(range(9999), key=lambda n: list(range(9999)))",
        "str([[0] * 20000] * 20000)",
        "('x' * 20000).join([''] * 20000)",
        "('x' * 20000).replace('x', 'y' * 20000)",
        "len([[i for i in range(20000)] for i in range(20000)])",
        "round(5, -10**8) + 'a'",
        "sum([[i] for i in range(20000)], [])",
        "range(10**12)",
        "(" * 2000 + ")" * 2000,
        "-" * 4000 + "1",
        "x" + ".x" * 2400,
        "[" + "x," * 2400 + "]*9999",
    ],
)
def test_a_hostile_expression_ends_at_once(text: str) -> None:
    """Time and memory are bounded whatever the text."""
    begin = time.process_time()
    with pytest.raises(ExpressionError):
        evaluate(text, NAMES)
    assert time.process_time() - begin < 1.0


def test_expressions_share_a_budget() -> None:
    """Many expressions together do no more than one that is as large as all of them."""
    budget = Budget(3_000)
    assert evaluate("len(range(900))", {}, budget) == 900
    with pytest.raises(ExpressionError):
        [evaluate("len(range(900))", {}, budget) for _ in range(5)]
    with pytest.raises(ExpressionError):
        evaluate("1", {}, budget)


ATOMS = st.sampled_from(["x", "side", "cfg", "1", "0", "'a'", "[1]", "10**9", "pi", "abs", "cfg.wheels", "''", "None"])


def _combined(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    operators = st.sampled_from(["+", "-", "*", "/", "//", "%", "**", "<", "==", "in", "and", "or", "if x else"])
    return st.one_of(
        st.tuples(inner, operators, inner).map(lambda parts: f"({parts[0]} {parts[1]} {parts[2]})"),
        st.tuples(inner, inner).map(lambda parts: f"{parts[0]}[{parts[1]}]"),
        st.tuples(st.sampled_from(["str", "len", "round", "sum", "range", "dict", "sqrt"]), inner).map(
            "{0[0]}({0[1]})".format
        ),
        st.tuples(inner, st.sampled_from(["join", "split", "format", "get", "items"]), inner).map(
            "{0[0]}.{0[1]}({0[2]})".format
        ),
    )


@settings(max_examples=50, deadline=None)
@given(st.one_of(st.text(max_size=60), st.recursive(ATOMS, _combined, max_leaves=12)))
def test_nothing_but_an_expression_error_is_raised(text: str) -> None:
    """Any text gives plain data or an ExpressionError, quickly."""
    try:
        found = evaluate(text, NAMES)
    except ExpressionError:
        return
    assert isinstance(found, str | int | float | bool | list | tuple | dict | slice | None)
    ast.literal_eval(repr(found).replace("inf", "1e999").replace("nan", "None"))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("python.set('b a b'.split())", ["b", "a"]),
        ("set([1, 2, 3]) - set([2])", [1, 3]),
        ("len(set([1, 1]) - set([1]))", 0),
        ("isinstance([1], (list, tuple))", True),
        ("isinstance(set([1]), list)", False),
    ],
)
def test_sets_keep_their_order(text: str, value: object) -> None:
    """What a set holds is said in the same order each time."""
    found = evaluate(text, {})
    assert (list(found) if isinstance(found, list) else found) == value


def test_a_lambda_is_a_value() -> None:
    """A property may hold a function; the names that it does not bind are those of the caller."""
    function = evaluate("lambda n: n * scale", {"scale": 1})
    assert evaluate("twice(3)", {"twice": function, "scale": 2}) == 6
    assert str(function) == "<function>"


def test_what_an_expression_is_given_is_not_changed() -> None:
    """Data of a file is read once for all expressions."""
    names: dict[str, Any] = {"table": {"a": [1]}}
    with pytest.raises(ExpressionError):
        evaluate("table['a'].append(2) or table", names)
    assert names == {"table": {"a": [1]}}


def test_a_name_hides_a_function_of_that_name() -> None:
    """A variable may have the name of a function, as in Python; a call means the function."""
    assert evaluate("map + '.yaml'", {"map": "office"}) == "office.yaml"
