"""Programs that `executed_values.py` draws: well formed, the same for a seed, and of every idea."""

from __future__ import annotations

from collections import Counter

import pytest
import tree_sitter_cpp
from executed.draw import Program
from executed.grammar import OF_NODE, grammar, holes, need_of
from tree_sitter import Language, Parser

LANGUAGES = ("cpp", "python")
SEEDS = tuple(map(str, range(40)))
DIRECTIVES = ("@draw ", "@block ", "@declare ")
_OF_THE_DRAWER = {"program", "statement", "publish", "text", "simple"}
"""Symbols that drawing starts from; `body`, `new` and `short` have no forms of their own."""


@pytest.fixture(params=LANGUAGES)
def language(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def _known(language: str) -> set[str]:
    return {symbol.removesuffix(OF_NODE) for symbol in grammar(language).forms}


def _asked(language: str) -> set[str]:
    texts = [form.text for known in grammar(language).forms.values() for form in known]
    named = {hole for text in texts for hole in holes(text) if not need_of(hole)}
    lines = [line.split() for text in texts for line in text.split("\n")]
    written = {words[1] for words in lines if words and words[0] in ("@draw", "@block")}
    return (named | written | _OF_THE_DRAWER) - {"body", "new", "new2", "short"}


def test_each_idea_has_forms_and_each_form_an_idea(language: str) -> None:
    """A language that lacks an idea, or has one more, is not compared with the other."""
    forms = grammar(language)
    assert {form.idea for known in forms.forms.values() for form in known} == set(forms.shares)


def test_each_symbol_that_a_form_asks_for_has_forms(language: str) -> None:
    assert _asked(language) <= _known(language)


def test_each_form_can_be_reached() -> None:
    """What no form asks for is never drawn, and is not covered."""
    assert set().union(*map(_known, LANGUAGES)) <= set().union(*map(_asked, LANGUAGES))


def test_each_idea_is_drawn(language: str) -> None:
    forms, drawn = grammar(language), Counter[str]()
    for seed in SEEDS:
        program = Program(seed, forms)
        program.source()
        drawn += program.ideas
    assert set(drawn) == set(forms.shares)


def test_the_same_seed_draws_the_same_program(language: str) -> None:
    forms = grammar(language)
    assert Program("7", forms).source() == Program("7", forms).source() != Program("8", forms).source()


def test_no_hole_is_left_open(language: str) -> None:
    forms = grammar(language)
    for seed in SEEDS:
        source = Program(seed, forms).source()
        assert not [line for line in source.split("\n") if "$" in line or line.lstrip().startswith(DIRECTIVES)]


def test_python_programs_compile() -> None:
    for seed in SEEDS:
        assert compile(Program(seed, grammar("python")).source(), "drawn.py", "exec")


def test_cpp_programs_parse() -> None:
    parser = Parser(Language(tree_sitter_cpp.language()))
    for seed in SEEDS:
        assert not parser.parse(Program(seed, grammar("cpp"), "p1").source().encode()).root_node.has_error
