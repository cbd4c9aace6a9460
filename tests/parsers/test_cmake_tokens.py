"""The CMake language: commands, arguments and comments."""

import pytest
from diagnosed import is_told
from ecm_parsers.cmake_tokens import parse_commands
from hypothesis import given, settings
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("text", "args"),
    [
        ("a(b c)", ["b", "c"]),
        ("A( b\n  c # no\n  d)", ["b", "c", "d"]),
        ('a("b c" d)', ["b c", "d"]),
        ('a("b\\\nc")', ["bc"]),
        ('a("x \\" ) y")', ['x \\" ) y']),
        ("a([[b ) c]] [=[d]]e]=])", ["b ) c", "d]]e"]),
        ("a(b #[[ c ) ]] d)", ["b", "d"]),
        ('a(-DX="b c" d)', ['-DX="b c"', "d"]),
        ("a(b\\ c ${D}/e $<F:g>)", ["b\\ c", "${D}/e", "$<F:g>"]),
        ("a((b OR c) AND d)", ["(", "b", "OR", "c", ")", "AND", "d"]),
    ],
)
def test_arguments(text: str, args: list[str]) -> None:
    """Arguments split as cmake-language(7) says."""
    (command,) = parse_commands(text.encode()).facts
    assert command.name == "a"
    assert [argument.text for argument in command.args] == args


def test_lines() -> None:
    """Commands and arguments know their 1-based line."""
    first, second = parse_commands(b"# c\na(b\n  c)\n\nd()\n").facts
    assert (first.line, [a.line for a in first.args], second.line) == (2, [2, 3], 5)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("a(b", "cmake-unclosed"),
        ('a("b', "cmake-unclosed"),
        ("a([[b", "cmake-unclosed"),
        ("?\na()", "cmake-syntax"),
    ],
)
def test_broken_text_is_reported(text: str, code: str) -> None:
    """What is not closed or no command is diagnosed, and commands are still read."""
    parsed = parse_commands(text.encode())
    assert code in [d.code for d in parsed.diagnostics]
    assert [c.name for c in parsed.facts] == ["a"]


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet='ab(){}[]="#$\\\n ;', max_size=80).map(str.encode))
def test_scanner_never_raises(data: bytes) -> None:
    """Any text gives commands or diagnostics."""
    assert is_told(data, parse_commands(data))
