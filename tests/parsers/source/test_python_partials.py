"""Partials that are kept: what they are given is told before, and each argument has its line."""

from __future__ import annotations

from ecm_parsers.source.expr import Call
from ecm_parsers.source.python import parse_python

TEXT = b"""
from functools import partial
class A:
    def f(self, table):
        self.make = partial(self.g, 1, *table, **table,
                            name="x",
                            other=2)
"""


def test_each_keyword_has_its_line() -> None:
    """Tables that are spread come last, with the lines that they have."""
    (method,) = [each for each in parse_python(TEXT).facts.functions if each.name == "f"]
    values = [each.value for each in method.body if isinstance(each.value, Call)]
    (made,) = [each for each in values if each.keywords]
    assert [name for name, _ in made.keywords] == ["name", "other", "**"]
    assert made.keyword_lines == (6, 7, 5)
