"""The checker reads no file and starts nothing: contracts in, findings out."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import ecm_checker
import pytest

PACKAGE = Path(ecm_checker.__file__).parent
FORBIDDEN = frozenset({"os", "pathlib", "io", "subprocess", "shutil", "socket", "tempfile", "glob", "sys", "yaml"})
FORBIDDEN_CALLS = frozenset({"open", "eval", "exec", "compile", "__import__"})


def imported(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""


@pytest.mark.parametrize("path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: path.stem)
def test_module_touches_nothing_outside(path: Path) -> None:
    """No file system, no process, no network, no evaluation; its own data comes through importlib.resources."""
    tree = ast.parse(path.read_text("utf-8"))
    assert not {name.partition(".")[0] for name in imported(tree)} & FORBIDDEN
    calls = {node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)}
    assert not calls & FORBIDDEN_CALLS
