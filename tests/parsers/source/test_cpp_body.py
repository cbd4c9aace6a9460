"""Statements of C++ bodies: what is bound, called, returned, in which order and how deep."""

from __future__ import annotations

from ecm_parsers.source.cpp import parse_cpp
from ecm_parsers.source.expr import Call, Constant, Expr, Items, Lambda, Member, Name, Number, Op, Opaque, Text
from ecm_parsers.source.facts import Function, Statement


def body(text: str) -> tuple[Statement, ...]:
    return parse_cpp(f"void f() {{ {text} }}".encode()).facts.functions[0].body


def shape(text: str) -> list[tuple[str, Expr | None, int]]:
    return [(statement.kind, statement.target, statement.depth) for statement in body(text)]


def test_declarations_keep_their_type() -> None:
    """A declaration has its type as written, with or without a value."""
    found = [(s.target, s.type, s.value) for s in body('std::string a = "x"; pkg::Thing b; const double c = 2.0;')]
    assert found == [
        (Name("a"), "std::string", Text("x")),
        (Name("b"), "pkg::Thing", None),
        (Name("c"), "const double", Number(2.0)),
    ]


def test_constructions_are_calls() -> None:
    """Parentheses, braces and what only looks like a function declaration make an object."""
    values = [s.value for s in body('ros::NodeHandle a("~"); Foo b{1}; tf::Listener c(buffer);')]
    assert values == [
        Call(Name("ros::NodeHandle"), (Text("~"),), line=1),
        Call(Name("Foo"), (Number(1),), line=1),
        Call(Name("tf::Listener"), (Name("buffer"),), line=1),
    ]


def test_constructions_from_calls_are_calls() -> None:
    """A call as argument reads as a parameter that is a function; what names its parameters is a declaration."""
    made = body("QoS a(KeepLast(depth_), make<T>(b, c())); Thing d(Other (*)(int)); Thing e(Other f);")
    assert [s.value for s in made] == [
        Call(
            Name("QoS"),
            (
                Call(Name("KeepLast"), (Name("depth_"),), line=1),
                Call(Name("make"), (Name("b"), Call(Name("c"), (), line=1)), (), ("T",), line=1),
            ),
            line=1,
        ),
    ]


def test_constructions_from_elements_are_calls() -> None:
    """`Thing a(argv[1]);` reads as a declaration with an array; it makes an object."""
    assert [s.value for s in body("Thing a(argv[1]); Other b(list[i + 1], c);")] == [
        Call(Name("Thing"), (Op("[]", (Name("argv"), Number(1))),), line=1),
        Call(Name("Other"), (Op("[]", (Name("list"), Op("+", (Name("i"), Number(1))))), Name("c")), line=1),
    ]


def test_a_chain_of_assignments_gives_its_value_to_all() -> None:
    """`a = b = c` sets b, then a."""
    assert [(s.kind, s.target, s.value) for s in body('a.b = c = "x";')] == [
        ("set", Name("c"), Text("x")),
        ("set", Member(Name("a"), "b"), Text("x")),
    ]


def test_assignments_and_appending() -> None:
    """`+=` and streams read as concatenation onto the target."""
    assert [(s.kind, s.target, s.value) for s in body('a = "x"; b_->c = 1; a += "y"; s << "z" << n;')] == [
        ("set", Name("a"), Text("x")),
        ("set", Member(Name("b_"), "c"), Number(1)),
        ("set", Name("a"), Op("+", (Name("a"), Text("y")))),
        ("set", Name("s"), Op("+", (Name("s"), Text("z"), Name("n")))),
    ]


def test_depth_counts_conditions_and_loops() -> None:
    """What always runs has depth 0, what a condition or loop encloses has more."""
    found = shape("a(); if (x) { b(); for (;;) { c(); } } else { d(); } try { e(); } catch (const E & error) { f(); }")
    assert [depth for _, _, depth in found] == [0, 1, 2, 1, 1, 2]


def test_range_loops_bind_each_element() -> None:
    """The variable of a range loop is bound to the elements of what it runs over."""
    first = body("for (const auto & name : names) { use(name); }")[0]
    assert (first.kind, first.target, first.value) == ("each", Name("name"), Name("names"))


def test_loops_of_macros_bind_each_element() -> None:
    """`BOOST_FOREACH` and blocks of other macros are no functions: what they hold is of the body."""
    found = body("BOOST_FOREACH(const Item & item, items[0]) { use(item); } FOR_ALL(x) { go(); }")
    assert [(s.kind, s.target, s.depth) for s in found] == [
        ("each", Name("item"), 1),
        ("do", None, 1),
        ("do", None, 1),
    ]
    assert found[0].value == Op("[]", (Name("items"), Number(0)))


def test_counting_is_an_assignment() -> None:
    """What a loop counts up is given a new value in each round."""
    found = body("int i = 0; int n = 2; while (true) { i++; n += 2; --i; }")
    counted = [s.value for s in found if s.kind == "set"]
    assert counted == [Op(op, (Name(n), Number(by))) for op, n, by in (("+", "i", 1), ("+", "n", 2), ("-", "i", 1))]


def test_printing_to_a_buffer_assigns_it() -> None:
    """`snprintf` and `sprintf` give their first argument the formatted text."""
    found = body('snprintf(a, sizeof(a), "x%d", i); sprintf(b, "%s", c()); snprintf(d, 1, format);')
    assert [(s.kind, s.target, s.value) for s in found[:2]] == [
        ("set", Name("a"), Op("%", (Text("x%d"), Items((Name("i"),)), Opaque("sizeof(a)")))),
        ("set", Name("b"), Op("%", (Text("%s"), Items((Call(Name("c"), (), line=1),))))),
    ]
    assert found[2].kind == "do"


def test_conditions_that_call_are_kept() -> None:
    """A call in a condition happens; so does a declaration there."""
    assert [s.kind for s in body("if (node->has(1)) {} if (auto p = get()) {} if (x > 2) {}")] == ["do", "let"]


def test_bodies_of_anonymous_lambdas_belong_to_the_function() -> None:
    """What a callback does happens in the module that wrote it."""
    calls = [s.value.callee for s in body("later([this]() { inner(1); });") if isinstance(s.value, Call)]
    assert calls == [Name("inner"), Name("later")]


def test_named_lambdas_are_functions() -> None:
    """A lambda bound to a name is a function with parameters of its own."""
    functions = parse_cpp(b"void f() { auto g = [&](const std::string & n) { h(n); }; }").facts.functions
    named: Function = next(function for function in functions if function.name == "g")
    assert (named.scope, [p.name for p in named.params], named.traits) == ("f", ["n"], ("lambda",))
    assert functions[0].body[-1].value == Lambda(("std::string",))


def test_constructor_initialisers_come_first() -> None:
    """Members and bases are initialised before the body runs."""
    text = b'class C : public B<int> { C() : B<int>("n", 1), a_("x"), b_{2}, c_() { d(); } };'
    found = [(s.kind, s.target, s.value) for s in parse_cpp(text).facts.functions[0].body]
    assert found == [
        ("init", Name("B"), Call(Name("B"), (Text("n"), Number(1)), (), ("int",), 1)),
        ("init", Name("a_"), Text("x")),
        ("init", Name("b_"), Items((Number(2),))),
        ("init", Name("c_"), Call(Name("c_"), (), line=1)),
        ("do", None, Call(Name("d"), (), line=1)),
    ]


def test_logging_is_left_out() -> None:
    """Statements that carry neither a value nor a call of use are not facts."""
    assert body('RCLCPP_INFO(get_logger(), "text"); i;') == ()


def test_returns() -> None:
    """Each returned value is kept."""
    assert [s.value for s in body("if (x) { return true; } return name_;")] == [Constant("true"), Name("name_")]
