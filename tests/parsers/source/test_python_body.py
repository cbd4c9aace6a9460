"""Statements, functions, classes and imports of Python sources."""

import pytest
from ecm_parsers.source.expr import REST, Call, Constant, Items, Member, Name, Number, Op, Opaque, Text
from ecm_parsers.source.facts import Class, Field, Function, Import, Parameter, SourceFile, Statement
from ecm_parsers.source.facts import Constant as ConstantFact
from ecm_parsers.source.python import parse_python

THIS = Name("this")
A, B, X, XS = Name("a"), Name("b"), Name("x"), Name("xs")


def facts(source: str) -> SourceFile:
    return parse_python(source.encode()).facts


def function(source: str, name: str) -> Function:
    return next(one for one in facts(source).functions if one.name == name)


def call(name: str, line: int = 1) -> Call:
    return Call(Name(name), (), line=line)


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("a = 1", [Statement("set", 1, Number(1), A)]),
        ("a = b = x()", [Statement("set", 1, call("x"), B), Statement("set", 1, B, A)]),
        ("a, b = 1, 2", [Statement("set", 1, Number(1), A), Statement("set", 1, Number(2), B)]),
        ("(a, b) = [1, 2]", [Statement("set", 1, Number(1), A), Statement("set", 1, Number(2), B)]),
        ("a, b = x()", [Statement("set", 1, call("x"), Items((A, B)))]),
        ("a, *b = 1, 2", [Statement("set", 1, Items((Number(1), Number(2))), Items((A, Op(REST, (B,)))))]),
        ("a: int = 1", [Statement("set", 1, Number(1), A, "int")]),
        ("a: List[int]", [Statement("let", 1, None, A, "List[int]")]),
        ("a += 'x'", [Statement("set", 1, Op("+", (A, Text("x"))), A, "+=")]),
        ("a['k'] = 1", [Statement("set", 1, Number(1), Op("[]", (A, Text("k"))))]),
        ("x()", [Statement("do", 1, call("x"))]),
        ("'doc'\na\n1 + 2\npass", []),
        ("del a", [Statement("set", 1, Opaque("a"), A, "del")]),
        ("del a[b]", [Statement("set", 1, Opaque("a[b]"), Op("[]", (A, B)), "del")]),
        ("for a in xs:\n  x()", [Statement("each", 1, XS, A), Statement("do", 2, call("x", 2), depth=1)]),
        ("while x():\n  a()", [Statement("do", 1, call("x")), Statement("do", 2, call("a", 2), depth=1)]),
        ("with a as b:\n  x()", [Statement("let", 1, A, B), Statement("do", 2, call("x", 2))]),
        ("with x():\n  pass", [Statement("do", 1, call("x"))]),
        ("raise x()", [Statement("do", 1, call("x"))]),
        ("print x()", [Statement("do", 1, call("x"))]),
        ("assert x(), 'm'", [Statement("do", 1, call("x"))]),
        ("if a: b = 1", [Statement("set", 1, Number(1), B, depth=1)]),
        (
            "if x(): a()\nelif x(): b()\nelse: x()",
            [
                Statement("do", 1, call("x")),
                Statement("do", 1, call("a"), depth=1),
                Statement("do", 2, call("x", 2), depth=1),
                Statement("do", 2, call("b", 2), depth=1),
                Statement("do", 3, call("x", 3), depth=1),
            ],
        ),
        (
            "try: a()\nexcept x as e: b()\nelse: x()\nfinally: x()",
            [
                Statement("do", 1, call("a")),
                Statement("do", 2, call("b", 2), depth=1),
                Statement("do", 3, call("x", 3)),
                Statement("do", 4, call("x", 4)),
            ],
        ),
        (
            "match x():\n  case 1 if a(): b()",
            [
                Statement("do", 1, call("x")),
                Statement("do", 2, call("a", 2), depth=1),
                Statement("do", 2, call("b", 2), depth=1),
            ],
        ),
        ("if __name__ == '__main__':\n  x()", [Statement("do", 2, call("x", 2), depth=1)]),
    ],
)
def test_module_body_is_the_statements_of_function_module(source: str, expected: list[Statement]) -> None:
    """Each statement carries its value, target and depth; what holds neither value nor call is left out."""
    module = facts(source).functions[0]
    assert module.name == "<module>"
    assert list(module.body) == expected


CLASS = """
@deco('x')
class Node(rclpy.node.Node, Generic[T], metaclass=M):
    '''Doc.'''
    RATE = 10
    name: str = 'n'
    pub = rospy.Publisher('x')
    kind: int

    def __init__(self, a, b: int = 1, *args, c: 'T' = None, **kw) -> None:
        self.x: float = 1.5
        self.create(a)

        def inner(y):
            return self.x

        def hidden(self):
            return self

    @staticmethod
    def make(a): return a

    @classmethod
    def _build(cls): return cls()
"""


def test_class_keeps_bases_as_written_and_its_fields() -> None:
    """Bases keep dots and brackets; attributes and annotated members of `__init__` are fields."""
    expected = Class(
        name="Node",
        scope="",
        bases=("rclpy.node.Node", "Generic[T]"),
        line=3,
        end_line=24,
        fields=(
            Field("RATE", "", 5, Number(10)),
            Field("name", "str", 6, Text("n")),
            Field("pub", "", 7, Call(Member(Name("rospy"), "Publisher"), (Text("x"),), line=7)),
            Field("kind", "int", 8),
            Field("x", "float", 11, Number(1.5)),
        ),
        traits=("remade",),
        decorators=(Call(Name("deco"), (Text("x"),), line=2),),
    )
    assert facts(CLASS).classes == (expected,)


def test_class_attribute_is_a_constant_and_runs_with_its_module_when_it_calls() -> None:
    """Attributes are constants in the scope of the class; those that call run in the enclosing body."""
    read = facts(CLASS)
    assert [(one.scope, one.name) for one in read.constants] == [
        ("Node", "RATE"),
        ("Node", "name"),
        ("Node", "pub"),
    ]
    assert [one.target for one in read.functions[0].body] == [None, Member(Name("Node"), "pub")]


def test_receiver_is_this_and_no_parameter() -> None:
    """The first parameter of a method is `this` in its body, in nested functions too unless they hide it."""
    init, inner, hidden = (function(CLASS, name) for name in ("__init__", "inner", "hidden"))
    assert init.params == (
        Parameter("a"),
        Parameter("b", "int", Number(1)),
        Parameter("*args"),
        Parameter("c", "'T'", Constant("null")),
        Parameter("**kw"),
    )
    assert init.returns == "None"
    assert init.body[1].value == Call(Member(THIS, "create"), (A,), line=12)
    assert (inner.scope, inner.params, inner.body[0].value) == (
        "Node::__init__",
        (Parameter("y"),),
        Member(THIS, "x"),
    )
    assert hidden.body[0].value == Name("self")


def test_decorators_are_kept_and_give_traits() -> None:
    """A static method keeps its parameters, a class method has a receiver, an underscore is private."""
    make, build = function(CLASS, "make"), function(CLASS, "_build")
    assert (make.params, make.traits, make.decorators) == ((Parameter("a"),), ("static",), ("staticmethod",))
    assert (build.params, build.traits, build.decorators) == ((), ("private",), ("classmethod",))
    assert build.body[0].value == Call(THIS, (), line=24)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("yield 1", True),
        ("for x in xs:\n        yield from x", True),
        ("a = yield", True),
        ("return 1  # yields nothing", False),
        ("return 'yield'", False),
        ("def inner():\n        yield 1\n    return inner", False),
        ("return lambda: (yield 1)", False),
    ],
)
def test_a_function_that_yields_is_a_generator(body: str, expected: bool) -> None:
    """What a function within it yields, and the word in a text or comment, make none of it."""
    found = function(f"def made():\n    {body}\n", "made")
    assert ("generator" in found.traits) is expected


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("import a.b as c, d", [Import("a.b", "", "c", 1), Import("d", "", "", 1)]),
        ("from a.b import c as d, e", [Import("a.b", "c", "d", 1), Import("a.b", "e", "", 1)]),
        ("from .a import (b, # why\n  c)", [Import(".a", "b", "", 1), Import(".a", "c", "", 2)]),
        ("from .. import x", [Import("..", "x", "", 1)]),
        ("from a import *", [Import("a", "*", "", 1)]),
        ("from __future__ import print_function", [Import("__future__", "print_function", "", 1)]),
        (
            "try:\n  import a\nexcept ImportError:\n  import b",
            [Import("a", "", "", 2), Import("b", "", "", 4)],
        ),
        ("def f():\n  import a", [Import("a", "", "", 2)]),
    ],
)
def test_import_is_read_wherever_it_stands(source: str, expected: list[Import]) -> None:
    """Imports of all forms and places are facts of the file."""
    assert list(facts(source).imports) == expected


def test_module_global_is_a_constant_too() -> None:
    """A global has a constant beside its statement, a local has none."""
    constants = facts("A = 'x'\nB: int = 2\ndef f():\n  c = 1\n").constants
    assert constants == (ConstantFact("A", "", Text("x"), 1), ConstantFact("B", "", Number(2), 2, "int"))


@pytest.mark.parametrize(
    ("body", "bound"),
    [
        ("print(a)", False),
        ("a.x = 1", False),
        ("del a", False),
        ("a = 1", True),
        ("a += 1", True),
        ("a, b = x()", True),
        ("for a in xs: x()", True),
        ("with x() as a: x()", True),
        ("import a", True),
        ("import b as a", True),
        ("from b import a", True),
        ("def a(): pass", True),
        ("class a: pass", True),
    ],
)
def test_a_global_of_a_function_is_a_name_of_the_module_when_the_function_binds_it(body: str, bound: bool) -> None:
    """The statement `global` says whose name is bound, and binds nothing (Python reference 7.12)."""
    constants = facts(f"def f():\n  global a\n  {body}\n").constants
    assert [entry.name for entry in constants] == ["a"] * bound


def test_shebang_is_kept_as_written() -> None:
    """Scripts without a suffix are told by their shebang."""
    assert facts("#!/usr/bin/env python\r\nx = 1").shebang == "#!/usr/bin/env python"


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("def f(a):\n    v = lambda b: a(b)\n", ["f", "v"]),
        (
            "def f(a):\n    self.v = lambda b: a(b)\n    return lambda b: a(b)\n",
            ["f", "<lambda 2:14>", "<lambda 3:12>"],
        ),
        ("def f(a):\n    v = lambda b: b\n    o.g(lambda b: a(b))\n", ["f"]),
        ("def f(a):\n    g(lambda b: a(b))\n    self.h(x=lambda b: a(b))\n", ["f", "<lambda 2:7>", "<lambda 3:14>"]),
        ("def f(a):\n    map(lambda b: a(b), a)\n", ["f"]),
    ],
)
def test_a_lambda_that_calls_and_has_a_holder_is_a_function(source: str, names: list[str]) -> None:
    """One that gets a name, is kept, returned or handed to a function; one that others are handed is not."""
    assert [each.name for each in facts(source).functions if each.name != "<module>"] == names
