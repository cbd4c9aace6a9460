"""The rules of the house that no linter knows."""

from __future__ import annotations

import pytest
from own_sources import OURS, sources

MOST_LINES = 350
LONGEST_FUNCTION = 40


@pytest.mark.parametrize("folder", OURS)
def test_nothing_is_known_by_its_address(folder: str) -> None:
    """An address is taken by something else once its object is gone; an object is a key itself."""
    inside = [source for source in sources() if source.path.startswith(f"{folder}/")]
    assert inside
    assert [f"{source.path}:{line}" for source in inside for line in source.addresses] == []


def test_files_are_short() -> None:
    """A file holds one idea."""
    assert {source.path: source.lines for source in sources() if source.lines > MOST_LINES} == {}


def test_functions_are_short() -> None:
    """A function is read at a glance."""
    functions = ((source.path, function) for source in sources() for function in source.functions)
    assert [f"{path}:{function.line}" for path, function in functions if function.length > LONGEST_FUNCTION] == []
