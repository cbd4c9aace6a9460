"""Attributes of C++ declarations."""

from __future__ import annotations

from ecm_parsers.source.cpp import parse_cpp


def test_attributes_announce_the_end_of_classes_and_members() -> None:
    """As they do of functions."""
    text = b'class [[deprecated("use B")]] A { public:\n [[deprecated(\n  "x")]]\n int a;\n int b; };'
    (cls,) = parse_cpp(text).facts.classes
    assert "deprecated" in cls.traits
    assert [(field.name, "deprecated" in field.traits) for field in cls.fields] == [("a", True), ("b", False)]


def test_attributes_of_functions_are_kept_one_by_one() -> None:
    """By their full names, with what they are given."""
    text = b'[[nodiscard, gnu::cold]] [[deprecated("a, b")]] int run() { return 1; }'
    (run,) = parse_cpp(text).facts.functions
    assert run.decorators == ("nodiscard", "gnu::cold", 'deprecated("a, b")')
