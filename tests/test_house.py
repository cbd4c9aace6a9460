"""The rules of the house that no linter knows."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
OURS = ("ecm_extract", "parsers/ecm_parsers", "checker/ecm_checker", "corpus/ecm_corpus")

MOST_LINES = 350
LONGEST_FUNCTION = 40


def _sources() -> list[Path]:
    return sorted(path for folder in OURS for path in (ROOT / folder).rglob("*.py"))


def _addresses(path: Path) -> Iterator[int]:
    """Lines that ask for the address of an object."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "id":
            yield node.lineno


@pytest.mark.parametrize("folder", OURS)
def test_nothing_is_known_by_its_address(folder: str) -> None:
    """An address is taken by something else once its object is gone; an object is a key itself."""
    inside = (path for path in _sources() if path.is_relative_to(ROOT / folder))
    found = [f"{path.relative_to(ROOT)}:{line}" for path in inside for line in _addresses(path)]
    assert found == []


def test_files_are_short() -> None:
    """A file holds one idea."""
    lengths = {str(path.relative_to(ROOT)): len(path.read_text("utf-8").splitlines()) for path in _sources()}
    assert {path: length for path, length in lengths.items() if length > MOST_LINES} == {}


def test_functions_are_short() -> None:
    """A function is read at a glance."""
    trees = ((path, ast.parse(path.read_text("utf-8"))) for path in _sources())
    functions = ((path, node) for path, tree in trees for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))
    long = [f"{path}:{node.lineno}" for path, node in functions if _length(node) > LONGEST_FUNCTION]
    assert long == []


def _length(node: ast.FunctionDef) -> int:
    return (node.end_lineno or node.lineno) - node.lineno + 1
