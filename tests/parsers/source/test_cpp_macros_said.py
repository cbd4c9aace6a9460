"""What macros stand for that is not put in is said."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp import parse_cpp

GET = "#define GET(name) node->get(name)\n"
TWO = "#if A\n" + GET + "#else\n#define GET(name) node->ask(name)\n#endif\n"
BOTH = [b"node->ask(name)", b"node->get(name)"]
ROWS = [
    ("one definition", GET + "void f() { GET(a); }", []),
    ("two that may hold", TWO + "void f() { GET(a); }", BOTH),
    ("two behind another", TWO + "#define TWICE(x) GET(x); GET(x)\nvoid f() { TWICE(a); }", BOTH),
    ("two that nobody calls", TWO, []),
    ("the rest by a name", "#define GET(name, rest...) node->get(name, rest)\nvoid f() { GET(a, b, c); }", []),
]


@pytest.mark.parametrize(("text", "bodies"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_macros_of_which_it_is_not_known_which_one_holds(text: str, bodies: list[bytes]) -> None:
    """What they may stand for is a fact of the file that calls them."""
    assert [each.body for each in parse_cpp(text.encode()).facts.undecided] == bodies


def test_more_macros_than_are_put_in() -> None:
    """Nothing is told of such calls, so that this is told."""
    read = parse_cpp((GET + "void f() { " + "GET(" * 60 + "a" + ")" * 60 + "; }").encode())
    assert [entry.cut for entry in read.diagnostics if entry.code == "cpp-macros-cut"] == [True]
