"""Names that a Python file uses and binds nowhere."""

from __future__ import annotations

import pytest
from ecm_parsers.source.python_names import loose_names

ROWS = [
    ("import os\nos.path", []),
    ("print os.path", ["os"]),
    ("# from a import *\nprint(b)", ["b"]),
    ("from a import *\nprint(b)", []),
    ("try:\n  b\nexcept NameError:\n  pass", []),
    ("exec('b = 1')\nprint(b)", []),
    ("import a.b.c as d, e.f\nd(e)", []),
    ("from . import (a as b,\n c)\nb(c, a)", ["a"]),
    ("import a\na.b(c=1).d", []),
    ("from os.path import join\njoin(os.sep)", ["os"]),
    ("try:\n  pass\nexcept Exception, e:\n  print e", []),
    ("try:\n  pass\nexcept (A, e):\n  print(e)", ["A", "e"]),
    ("try:\n  pass\nexcept Exception as e:\n  print(e)", []),
    ("def f(a, b=1, *c, **d):\n  return a, b, c, d", []),
    ("def f((a, b)):\n  return a, b", []),
    ("f = lambda a: a", []),
    ("def f():\n  g()\ndef g():\n  pass", []),
    ("for a, (b, *c) in []:\n  a, b, c", []),
    ("[a for a in b]", ["b"]),
    ("with open('a') as (a, b):\n  a, b", []),
    ("if (a := 1):\n  a", []),
    ("a.b = 1\nc[0] = 1", ["a", "c"]),
    ("a = b = 1\na, b", []),
    ("a: int = 1\na", []),
    ("def f():\n  global a\n  a += 1", []),
    ("class A(B, metaclass=C):\n  pass", ["B", "C"]),
    ("@a\ndef f(): pass", ["a"]),
    ("f'{a!r:>{b}}'", ["a", "b"]),
    ("match 1:\n  case [a, b]:\n    a, b", []),
    ("unicode(raw_input(), xrange(3))", []),
    ("class A:\n  def f():\n    return self.a\n  def g(self):\n    return self.a", ["self"]),
    ("class A:\n  @staticmethod\n  def f():\n    return 1\n  def g(*args):\n    self = args[0]\n    return self", []),
    ("class A:\n  def f(self):\n    def g():\n      return self\n    return g", []),
    ("def f(:\n  a", []),
    ("{% if a %}", []),
    ("\n    a = b\n    c(a)\n", []),
    ("a = b\n\tc = d\n", []),
    ("\ufeffa = b", ["b"]),
    ("# x\n  # y\na = b; c = d", ["b", "d"]),
    ("def f():\n  raise NotImplementedError\n  return a", []),
    ("if False:\n  b = a\nelse:\n  c", ["c"]),
    ("if 0:\n  b = a\nb", []),
    ("def f():\n  if g():\n    return 1\n  return a\ndef g(): pass", ["a"]),
    ("def f():\n  return h\n  h = 1", []),
    ("while 1:\n  break\n  a\nb", ["b"]),
]


@pytest.mark.parametrize(("text", "expected"), ROWS)
def test_loose_names(text: str, expected: list[str]) -> None:
    """A name is bound wherever a statement binds it; what may bind more while it runs is left out."""
    assert [name for name, _ in loose_names(text.encode())] == expected


def test_the_first_use_is_named() -> None:
    """One line for each name."""
    assert loose_names(b"import a\nb(a)\nb\n") == [("b", 2)]
