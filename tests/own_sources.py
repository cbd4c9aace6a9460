"""Our own sources, each parsed once for all rules of the house that are asked of it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
OURS: Final = ("ecm_extract", "parsers/ecm_parsers", "checker/ecm_checker", "corpus/ecm_corpus")


@dataclass(frozen=True, slots=True)
class Compared:
    """A comparison: the names and attributes in it, and the texts."""

    names: frozenset[str]
    texts: frozenset[str]


@dataclass(frozen=True, slots=True)
class Function:
    """A function and how many lines it has."""

    line: int
    length: int


@dataclass(frozen=True, slots=True)
class Source:
    """What the rules ask of a file.

    Attributes:
        path: from the root of the project.
        lines: how many it has.
        texts: all texts, as often as they stand there.
        compared: its comparisons with texts.
        groups: its lists, sets and tuples of texts alone.
        functions: all functions and methods.
        addresses: the lines that ask for the address of an object.
    """

    path: str
    lines: int
    texts: tuple[str, ...]
    compared: tuple[Compared, ...]
    groups: tuple[frozenset[str], ...]
    functions: tuple[Function, ...]
    addresses: tuple[int, ...]


@cache
def sources() -> tuple[Source, ...]:
    """All files of ours, by their path."""
    paths = (path for folder in OURS for path in sorted((ROOT / folder).rglob("*.py")))
    return tuple(_source(path) for path in paths)


def _source(path: Path) -> Source:
    code = path.read_text("utf-8")
    nodes = list(ast.walk(ast.parse(code)))
    return Source(
        path=str(path.relative_to(ROOT)),
        lines=len(code.splitlines()),
        texts=tuple(_texts(nodes)),
        compared=tuple(each for node in nodes for each in _compared(node)),
        groups=tuple(each for node in nodes for each in _group(node)),
        functions=tuple(Function(each.lineno, _length(each)) for each in nodes if isinstance(each, ast.FunctionDef)),
        addresses=tuple(node.lineno for node in nodes if isinstance(node, ast.Call) and _is_id(node.func)),
    )


def _texts(nodes: list[ast.AST]) -> Iterator[str]:
    return (node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str))


def _compared(node: ast.AST) -> Iterator[Compared]:
    if isinstance(node, ast.Compare | ast.MatchValue):
        inside = list(ast.walk(node))
        texts = frozenset(_texts(inside))
        if texts:
            yield Compared(frozenset(_names(inside)), texts)


def _names(nodes: list[ast.AST]) -> Iterator[str]:
    for node in nodes:
        if isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.Name):
            yield node.id


def _group(node: ast.AST) -> Iterator[frozenset[str]]:
    """The texts of a collection of several different ones."""
    if isinstance(node, ast.Set | ast.Tuple | ast.List) and len(node.elts) > 1:
        texts = frozenset(_texts(list(node.elts)))
        if len(texts) == len(node.elts):
            yield texts


def _length(node: ast.FunctionDef) -> int:
    return (node.end_lineno or node.lineno) - node.lineno + 1


def _is_id(callee: ast.expr) -> bool:
    return isinstance(callee, ast.Name) and callee.id == "id"
