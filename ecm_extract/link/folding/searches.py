"""Searches in tables and sets of C++: `table.count(key)`, and what `table.find(key)` gives.

An iterator is known as long as the table is the one that was searched: nobody changed it since.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.link.folding.fold_tables import Entry
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, constant, demoted

if TYPE_CHECKING:
    from ecm_extract.link.code.calls import Invocation
    from ecm_extract.link.folding.fold import Folder

_ENDS: Final = frozenset({"end", "cend"})
_ASKED: Final = frozenset({"count", "contains"})
_PARTS: Final = ("first", "second")


class Search(NamedTuple):
    """A search: in which table, for what, where it stands."""

    table: Expr
    key: Expr
    env: Env


class SearchFolder:
    """Evaluates searches."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def count(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """Return how many entries of a table have a key; None for other calls."""
        if call.last not in _ASKED or len(call.args) != 1 or call.receiver is None:
            return None
        has = self._in_any(call.receiver, call.args[0], env)
        if has is None:
            return None
        return demoted((constant(has if call.last == "contains" else int(has)),))

    def compared(self, expr: Op, env: Env) -> tuple[Value, ...] | None:
        """`found == table.end()`; None for what compares anything else."""
        if expr.op not in {"==", "!="} or len(expr.operands) != 2:
            return None
        for one, other in (expr.operands, expr.operands[::-1]):
            search = self._search(one, env) if _is_end(other) else None
            if search is not None and isinstance(other, Call) and isinstance(other.callee, Member):
                same = other.callee.base == search.table
                has = self._found(search, env) if same else None
                return None if has is None else demoted((constant(has is (expr.op == "!=")),))
        return None

    def part(self, expr: Member, env: Env) -> Bound | None:
        """Return the key or the value that an iterator points to: `found->second`; None where that is not known."""
        if expr.name not in _PARTS or env.func.file.language != "cpp":
            return None
        search = self._search(expr.base, env)
        entries = self._entries(search, env) if search is not None else None
        if search is None or entries is None:
            return None
        if expr.name == "first":
            return Bound(search.key, search.env) if self._has(entries, search.key, search.env) else None
        return self.folder.tables.chosen(entries, search.key, search.env)

    def _found(self, search: Search, env: Env) -> bool | None:
        return self._in_any(search.table, search.key, search.env) if self._is_as_searched(search, env) else None

    def _in_any(self, table: Expr, key: Expr, env: Env) -> bool | None:
        """Whether a table has a key in every run, or in none of them; None where that is not decided."""
        entries = self.folder.tables.entries(table, env)
        if entries is not None:
            return self._has(entries, key, env)
        perhaps = self.folder.perhaps.entries(table, env)
        if perhaps is None:
            return None
        if self._has([each.entry for each in perhaps if each.surely], key, env):
            return True
        return None if self._has([each.entry for each in perhaps], key, env) is not False else False

    def _has(self, entries: list[Entry], key: Expr, env: Env) -> bool | None:
        """Whether a table has a key; None where that is not decided."""
        alike = [
            self.folder.flow.alike(key, Name("#key"), self.folder.flow.naming(env, {"#key": entry.key}))
            for entry in entries
        ]
        return True if True in alike else None if None in alike else False

    def _entries(self, search: Search, env: Env) -> list[Entry] | None:
        """The entries of the table that was searched, unless it may have changed since."""
        as_searched = self._is_as_searched(search, env)
        return self.folder.tables.entries(search.table, search.env) if as_searched else None

    def _is_as_searched(self, search: Search, env: Env) -> bool:
        if search.env.func is not env.func:
            return False
        then, now = (self.folder.flow.ways(search.table, place) for place in (search.env, env))
        return set(then) == set(now)

    def _search(self, expr: Expr, env: Env) -> Search | None:
        """The search that gave an iterator: itself, or the one thing that a variable holds."""
        if isinstance(expr, Call):
            callee = expr.callee
            found = isinstance(callee, Member) and callee.name == "find" and len(expr.args) == 1
            return Search(callee.base, expr.args[0], env) if found and isinstance(callee, Member) else None
        if not isinstance(expr, Name):
            return None
        helds = {held for way in self.folder.flow.ways(expr, env) for held in way}
        held = helds.pop() if len(helds) == 1 else None
        if held is None or held.how != "value" or held.env is None or not isinstance(held.expr, Call):
            return None
        return self._search(held.expr, held.env)


def _is_end(expr: Expr) -> bool:
    ends = isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.name in _ENDS
    return ends and isinstance(expr, Call) and not expr.args
