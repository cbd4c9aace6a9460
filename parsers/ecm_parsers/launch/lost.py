"""Actions of a Python launch file that a variable holds and that nothing ever takes from it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from ecm_parsers.launch.model import Include, Node
from ecm_parsers.python.values import Value
from ecm_parsers.result import Diagnostic

REPLACED: Final = "launch-action-replaced"
UNUSED: Final = "launch-action-unused"


def lost_actions(tree: ast.Module, made: Mapping[ast.stmt, Value]) -> Iterator[Diagnostic]:
    """Yield each action that a function binds to a name which is bound anew, or not read at all.

    Args:
        tree: the file.
        made: what each assignment that was read binds.
    """
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            own = _Function(function, made)
            for block in _blocks(function.body):
                yield from own.lost(block)


class _Function:
    """A function, with the names that it reads."""

    def __init__(self, node: ast.FunctionDef, made: Mapping[ast.stmt, Value]) -> None:
        self._made = made
        self._read = _loads(node.body)
        self._shared = {name for each in ast.walk(node) if isinstance(each, _LINKS) for name in each.names}
        inner = [each for each in ast.walk(node) if isinstance(each, _FUNCTIONS) and each is not node]
        self._shared |= _loads(inner)
        self._hides = "locals" in self._read

    def lost(self, block: Sequence[ast.stmt]) -> Iterator[Diagnostic]:
        """Yield the actions of one block."""
        for at, statement in enumerate(block):
            name = _bound(statement)
            if name is None or name in self._shared or self._hides:
                continue
            if isinstance(self._made.get(statement), Node | Include):
                again = _bound_again(name, block[at + 1 :])
                if again is not None and ast.dump(again) == ast.dump(statement):
                    continue
                if again is not None:
                    yield _problem(REPLACED, statement, name, f"`{name}` is bound anew before anything takes it")
                elif name not in self._read:
                    yield _problem(UNUSED, statement, name, f"nothing takes `{name}`")


_LINKS = (ast.Global, ast.Nonlocal)
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def _bound(statement: ast.stmt) -> str | None:
    """The one name that a statement binds and does no more with."""
    if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
        target = statement.targets[0]
        return target.id if isinstance(target, ast.Name) else None
    return None


def _bound_again(name: str, following: Sequence[ast.stmt]) -> ast.stmt | None:
    """The statement of the block that binds a name anew, None where something reads it before."""
    for statement in following:
        if name in _loads([statement]):
            return None
        if _bound(statement) == name:
            return statement
    return None


def _loads(nodes: Sequence[ast.AST]) -> set[str]:
    return {
        each.id
        for node in nodes
        for each in ast.walk(node)
        if isinstance(each, ast.Name) and not isinstance(each.ctx, ast.Store)
    }


def _blocks(body: Sequence[ast.stmt]) -> Iterator[Sequence[ast.stmt]]:
    """Yield a block and those inside it, functions left out."""
    yield body
    for statement in body:
        if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            continue
        for name in ("body", "orelse", "finalbody"):
            inner = getattr(statement, name, None)
            if inner:
                yield from _blocks(inner)


def _problem(code: str, statement: ast.stmt, name: str, wrong: str) -> Diagnostic:
    advice = f"Give the action a name of its own and add it, or remove it (`{name}`)"
    return Diagnostic("warning", code, statement.lineno, f"{wrong}. {advice}.", wrong=wrong, advice=advice)
