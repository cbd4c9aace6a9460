"""What macros stand for that is not put in is said."""

from __future__ import annotations

import pytest
from ecm_parsers.source.cpp import parse_cpp

GET = "#define GET(name) node->get(name)\n"
TWO = "#if A\n" + GET + "#else\n#define GET(name) node->ask(name)\n#endif\n"
ROWS = [
    ("one definition", GET + "void f() { GET(a); }", []),
    ("two that may hold", TWO + "void f() { GET(a); }", ["cpp-macros"]),
    ("two that nobody calls", TWO, []),
    ("macros without end", GET + "void f() { " + "GET(" * 60 + "a" + ")" * 60 + "; }", ["cpp-macros-cut"]),
    ("the rest by a name", "#define GET(name, rest...) node->get(name, rest)\nvoid f() { GET(a, b, c); }", []),
]  # fmt: skip


@pytest.mark.parametrize(("text", "codes"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_what_is_left_as_it_is_written(text: str, codes: list[str]) -> None:
    """Nothing is told of such calls, so that this is told."""
    read = parse_cpp(text.encode())
    assert [entry.code for entry in read.diagnostics if entry.code.startswith("cpp-macros")] == codes
    assert all(entry.cut == (entry.code == "cpp-macros-cut") for entry in read.diagnostics)
