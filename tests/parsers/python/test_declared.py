"""What is known of the names of a file that declares something, branches that are not decided among it."""

from __future__ import annotations

import pytest
from ecm_parsers.python.declared import declarations, pattern_of

OPEN = "{x}"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("x = 'a'\nif other: x = 'b'", OPEN),
        ("x = 'a'\nif other: x = 'a'", "a"),
        ("x = 'a'\nwhile other: x = 'b'", OPEN),
        ("x = 'a'\nwhile False: x = 'b'", "a"),
        ("x = 'a'\nfor each in other: x = 'b'", OPEN),
        ("x = 'a'\nfor each in ['b', 'c']: x = each", "c"),
        ("for x in ['a', 'b', 'c']:\n  if x == 'b': break", "b"),
        ("for x in ['a', 'b', 'c']:\n  if other: break", OPEN),
        ("x = 'a'\nfor each in ['b', 'c']:\n  if other: continue\n  x = each", OPEN),
        ("x = 'a'\nfor each in ['b']:\n  x = each\n  if other:\n    x = 'c'\n    break", OPEN),
        ("try: x = f()\nexcept OSError: x = 'a'", OPEN),
        ("def f():\n  if other: return 'a'\n  return 'a'\nx = f()", "a"),
        ("def f():\n  if other: return 'a'\n  return 'b'\nx = f()", "{}"),
        ("def f():\n  if other: return 'a'\nx = f()", "{}"),
        ("p = ['a']\ndef f(): p.append('b')\nif other: f()\nx = len(p)", "{}"),
        ("p = {}\nif other: p['a'] = 'b'\nx = p['a']", "b"),
        ("p = {}\nif other: p['a'] = 'b'\nx = p.get('a', 'c')", "{}"),
        ("p = {'a': 'b'}\np.update(other)\nx = p['a']", "{p['a']}"),
        ("p = {'a': 'b'}\np.update(other)\np['a'] = 'c'\nx = p['a']", "c"),
        ("p = {**other, 'a': 'b'}\nx = p['a']", "b"),
        ("p = {'a': 'b', **other}\nx = p['a']", "{p['a']}"),
        ("x = other or 'a'", "{}"),
        ("x = '' or 'a'", "a"),
        ("x = 'a/%s_%d' % (other, 3)", "a/{other}_3"),
        ("x = f'{other}/{1:02d}'", "{other}/01"),
        ("import os\nx = os.environ['HOME'] + '/a'", "{HOME}/a"),
        ("from math import *\nx = round(pi, 2)", "3.14"),
        ("class A:\n  def __init__(self): self.b = 'c'\nx = A().b", "c"),
        ("a = A()\na.b = 'c'\nif other: a.b = 'd'\nx = a.b", "{a.b}"),
        ("if __name__ == '__main__': x = 'a'", "a"),
        ("print 'a'\nx = 010", "8"),
    ],
)
def test_what_a_name_holds(text: str, value: str) -> None:
    """A value is told where it is sure; what a branch may change is open."""
    reader = declarations({})
    reader.read(text)
    assert pattern_of(reader.module.names["x"]) == value
