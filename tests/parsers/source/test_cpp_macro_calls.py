"""What stands for the calls of a file's own macros."""

from __future__ import annotations

from time import monotonic

import pytest
from ecm_parsers.source.cpp_macro_calls import MAX_CALLS, MAX_PUT, with_macro_calls
from ecm_parsers.source.cpp_macro_definitions import MAX_BODY

PUB = "#define PUB(var, type, ...) do { log(#type); var = node->create<type>(__VA_ARGS__); } while (0)\n"
OPT = "#define ASK(name, ...) node->ask(name __VA_OPT__(, more(__VA_ARGS__)), 1)\n"
GET = "#define GET(name) node->get(name)\n"
ROWS = [
    (PUB, 'PUB(a_, a::T, "a", 10);', 'do { log("a::T"); a_ = node->create<a::T>("a", 10); } while (0);'),
    (GET, "int x = GET(f(a, b)) + 1;", "int x = node->get(f(a, b)) + 1;"),
    (OPT, "ASK(a); ASK(a, b, c);", "node->ask(a , 1); node->ask(a , more(b, c), 1);"),
    (GET, "GET(//what\n  a);", "node->get(\n  a);"),
    (GET + "#define ALL(x) a.run(GET(x))\n", "ALL(1);", "a.run(node->get(1));"),
    ("#define OPEN node->create<a::T>\n", "OPEN(1); x = OPEN;", "node->create<a::T>(1); x = OPEN;"),
    ("#define OPEN create<a::T>\n#define SURE(x) OPEN(x, 1)\n", "SURE(2);", "create<a::T>(2, 1);"),
    ("#define NONE() node->open()\n", "NONE();", "node->open();"),
    (GET, "GET(a, b); s = \"GET(a)\"; // GET(a)", "GET(a, b); s = \"GET(a)\"; // GET(a)"),
    ("#define JOIN(a) node->get_##a##_b()\n", "JOIN(x);", "node->get_x_b();"),
    (GET + "#define NAME x\n#define JOIN(a) GET(a##1)\n", "JOIN(NAME);", "node->get(NAME1);"),
    (GET + "#define BIT(x) (1 << x)\n", "BIT(1);" * 3_000 + "GET(a);", "BIT(1);" * 3_000 + "node->get(a);"),
    (GET, "GET(GET(a));", "node->get(node->get(a));"),
    (GET + "#define TRY(x) if (!(x)) stop\n", "TRY(GET(a));", "if (!(node->get(a))) stop;"),
    (GET + "#define TRY(x) if (!(x)) stop\n", "TRY(a);", "TRY(a);"),
    ("#define ROWS ROW(a, 1) ROW(b, 2)\n#define ROW(n, v) int n = v;\n", "ROWS", "ROWS"),
    ("#define ROWS ROW(a) ROW(b)\n#define ROW(n) int n;\n#undef ROW\n#define ROW(n) o.get(#n);\n", "ROWS",
     'o.get("a"); o.get("b");'),
    ("#define ROWS ROW(a) ROW(b)\n#define ROW(n) o.get(#n);\n#define ALL(rows, last) rows last();\n", "ALL(ROWS, end)",
     'o.get("a"); o.get("b"); end();'),
    (GET + "#ifdef A\n#undef GET\n#define GET(x) node->ask(x)\n#endif\n", "GET(a);", "GET(a);"),
    ("#ifdef A\n" + GET + "#undef GET\n#define GET(x) node->ask(x)\n#endif\n", "GET(a);", "node->ask(a);"),
    ("#define SUM(a) ((a) + 1)\n", "SUM(x);", "SUM(x);"),
    ("#define SUM(a) if (sizeof(a) > 1) (int)(a)\n", "SUM(x);", "SUM(x);"),
    ("#define GET(a) get<int>(#a)\n", "GET(x);", 'get<int>("x");'),
    ("#define GET(a) get_##a(1)\n", "GET(x);", "get_x(1);"),
    ("#define OPEN(a) node->create<a>\n", "OPEN(T)(1);", "node->create<T>(1);"),
    (GET + "#undef GET\n", "GET(a);", "GET(a);"),
    ("#ifdef A\n" + GET + "#else\n#define GET(name) node->ask(name)\n#endif\n", "GET(a);", "GET(a);"),
    ("#define AGAIN(a) node->get(AGAIN(a))\n", "NOT_AGAIN(a); AGAIN(b);", "NOT_AGAIN(a); node->get(AGAIN(b));"),
]  # fmt: skip


@pytest.mark.parametrize(("head", "call", "expected"), ROWS, ids=[row[1][:24] for row in ROWS])
def test_calls(head: str, call: str, expected: str) -> None:
    """A macro that calls something is put in as the standard says; what is not sure is left as it is written."""
    assert with_macro_calls((head + call).encode()).data.decode() == head + expected


def test_lines_stay_where_they_are() -> None:
    """What follows a call of several lines has the line that it had."""
    data = f"{PUB}PUB(a_,\n  T,\n  [](int x) {{\n    run(x);\n  }});\nlast();\n".encode()
    put = with_macro_calls(data).data.split(b"\n")
    assert (len(put), put[-2], b"run(x);" in put[4]) == (data.count(b"\n") + 1, b"last();", True)


def test_a_file_of_too_many_calls_is_left_alone() -> None:
    """Macros that call each other cannot make a file grow without end."""
    data = (GET + "GET(a);\n" * (MAX_CALLS + 1)).encode()
    assert with_macro_calls(data).data == data


def test_a_macro_that_is_too_long_is_told() -> None:
    """What it would declare is not known; a table of numbers declares nothing."""
    long = "/* */ " + "a, " * MAX_BODY
    assert with_macro_calls(f"#define GET(name) {long} node->get(name)\nGET(a);\n".encode()).is_cut
    assert not with_macro_calls(f"{GET}#define TABLE(name) {long}\nTABLE(a);\n".encode()).is_cut


MANY = 3_000
HOSTILE = {
    "arguments that double": "#define TWICE(x) x x\n" + GET + "TWICE(" * 60 + "GET(a)" + ")" * 60 + ";\n",
    "calls in calls": GET + "GET(" * MANY + "a" + ")" * MANY + ";\n",
    "a body of many uses": "#define MANY(x) " + "x " * 1_500 + "\n" + GET + f"MANY(GET({'a' * 60_000}));\n",
    "a long way to a call": "".join(f"#define M{at} M{at + 1}\n" for at in range(MANY))
    + f"#define M{MANY}(x) o.get(x)\nM0(1);\n",
    "many macros": "".join(f"#define M{at}(x) o.get{at}(x)\n" for at in range(MANY)) + "word " * 60_000,
    "many definitions of one": "#define GET(x) o.get(x)\n" * MANY + "GET(a);\n" * 500,
    "many conditionals": "#if A\n" * MANY + GET * 300 + "GET(a);\n",
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE.keys())
def test_macros_of_somebody_else_take_no_time(text: str) -> None:
    """What would stand for itself without end is left as it is written."""
    begin = monotonic()
    found = with_macro_calls(text.encode()).data
    assert monotonic() - begin < 3
    assert len(found) <= len(text) + 2 * MAX_PUT
