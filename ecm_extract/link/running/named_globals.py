"""Variables of Python modules that somebody changes by the text of their name: `globals()["X"] = y`.

Sources: docs.python.org, built-in functions (`globals`, `exec`), `sys.modules`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.units import File, Func
from ecm_extract.link.code.walk import dotted, last_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_GLOBALS: Final = Name("globals")
_MODULES: Final = "sys.modules"
_RUNS: Final = "exec"
_WAYS: Final = frozenset({"globals", "modules", _RUNS})
_ANY: Final = "*"
"""Stands for every variable."""
_LEAVING: Final = frozenset({"eval", "dict", "len", "list", "sorted", "set", "print", "str", "tuple"})
"""Functions that only look at the table of variables."""
_READING: Final = frozenset({"get", "keys", "values", "items", "copy"})
"""Methods of the table that leave it as it is: docs.python.org, dict."""


class NamedGlobals:
    """Tells who changes a variable so; each function is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._writing: dict[File, dict[Func, Set[str]]] = {}

    def writers(self, name: str, file: File) -> Sequence[Func]:
        """Return the functions of a module that may give a variable of it something by its name."""
        known = self._writing.get(file)
        if known is None:
            every = ((func, self._written(func)) for func in self.folder.program.functions_in(file))
            known = self._writing[file] = {func: names for func, names in every if names}
        return [func for func, names in known.items() if name in names or _ANY in names]

    def _written(self, func: Func) -> Set[str]:
        if self.folder.shifting.names(func).isdisjoint(_WAYS):
            return frozenset()
        by_statements = (name for entry in func.fact.body for name in _by_statement(entry))
        by_calls = (_ANY for group in func.calls for call in group if _changes_any(call, func))
        return frozenset({*by_statements, *by_calls})


def _by_statement(statement: Statement) -> Iterator[str]:
    target = statement.target
    if isinstance(target, Op) and target.op == "[]" and _is_table(target.operands[0]):
        key = target.operands[1]
        yield key.value if isinstance(key, Text) else _ANY
    if isinstance(target, Member) and _is_module(target.base):
        yield target.name
    if statement.kind in {"set", "return"} and _is_table(statement.value):
        yield _ANY  # who has the table may change it


def _changes_any(call: Call, func: Func) -> bool:
    callee = call.callee
    if isinstance(callee, Member) and _is_table(callee.base):
        return callee.name not in _READING
    runs = callee == Name(_RUNS) and func.fact.name == "<module>"
    given = [*call.args, *(value for _, value in call.keywords)]
    return runs or (last_of(callee) not in _LEAVING and any(map(_is_table, given)))


def _is_table(expr: Expr | None) -> bool:
    return isinstance(expr, Call) and expr.callee == _GLOBALS


def _is_module(expr: Expr) -> bool:
    return isinstance(expr, Op) and expr.op == "[]" and dotted(expr.operands[0]) == _MODULES
