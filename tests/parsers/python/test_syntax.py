"""Texts of every Python as trees of this one."""

from __future__ import annotations

import ast
import time

import pytest
from ecm_parsers.python.syntax import of_either_python


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("x = 1", "x = 1"),
        ("print 'a', b\nx = 1", "_; x = 1"),
        ("print >>f, 'a' % (\n  b)\nx = 1", "(print >> f, 'a' % b); x = 1"),
        ("exec 'a' in b", "_"),
        ("print\nx = `a`", "print; x = repr(a)"),
        ("raise E, 'a'", "raise _"),
        ("try:\n    a()\nexcept (A, B), e:\n    b()", "try:;     a(); except (A, B) as e:;     b()"),
        ("x = [017, 10L, 0, 00, 0x1fL]", "x = [15, 10, 0, 0, 31]"),
        ("x = ur'a\\b'", "x = 'a\\\\b'"),
        ("x = a <> b", "x = a != b"),
        ("print ''\ndef f(a, (b, c)): pass", "_; ; def f(a, _):;     pass"),
        ("print ''\nx = lambda (a, b): 1", "_; x = lambda _: 1"),
        ("if a:\n\tx = 1\n        y = 2", "if a:;     x = 1;     y = 2"),
    ],
)
def test_what_python_2_writes_in_another_way(text: str, written: str) -> None:
    """Statements and literals of Python 2 are read, and nothing of a file is lost for them."""
    syntax = of_either_python(text)
    assert (ast.unparse(syntax.module).replace("\n", "; "), syntax.is_whole) == (written, True)


def test_lines_stay() -> None:
    """What is written anew takes the lines that it had."""
    (_, last) = of_either_python("print ('a',\n\n'b') % `c`\nx = 1").module.body
    assert last.lineno == 4


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("x = (1 +\ny = 2\nz = 3", "_; z = 3"),
        ("if a:\n    x = )\n    y = 2\nz = 3", "if a:;     _; z = 3"),
        ("if a b:\n    x = 1\ny = 2", "_; y = 2"),
        ("print 'a'\nx = {,}\ny = 2", "_; _; y = 2"),
    ],
)
def test_mistakes_are_left_out(text: str, written: str) -> None:
    """What no Python takes is left out, the statements beside it are read."""
    syntax = of_either_python(text)
    assert (ast.unparse(syntax.module).replace("\n", "; "), syntax.is_whole) == (written, False)


@pytest.mark.parametrize("text", ["x = " + "(" * 20_000, "x = 1\0", "a" + ".b(1)" * 20_000, "f(" * 5_000])
def test_hostile_texts_end(text: str) -> None:
    """Nesting without end gives no tree, soon."""
    started = time.process_time()
    assert not of_either_python(text).is_whole
    assert time.process_time() - started < 2
