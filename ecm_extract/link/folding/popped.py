"""`table.pop(key, default)` of Python: what it gives, and what it leaves in the table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Comprehension, Expr, Lambda, Name

from ecm_extract.infer.held import State
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.walk import expressions, last_of
from ecm_extract.link.folding.fold_tables import Entry
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

POP: Final = "pop"


class Popped:
    """Takes entries out of tables."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def value(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """Return what a call gives; None where that is not known, or its statement takes more out than this."""
        if call.receiver is None or not _takes(call.args, env):
            return None
        entries = self.folder.tables.entries(call.receiver, env)
        if entries is not None:
            return self.folder.tables.entry_or(entries, call.args[0], call.args[1:], env)
        return self.of_giver(call.receiver, env)

    def of_giver(self, table: Expr, env: Env) -> tuple[Value, ...] | None:
        """Return what stands for an entry of a table that somebody gives, who knows it; None for all other tables."""
        if not isinstance(table, Name) or table.id not in env.func.given or env.func.file.language != "python":
            return None
        whole = self.folder.fold(table, env.entry(State()))
        return whole if all(value.open("param") | value.open("made") for value in whole) else None

    def element(self, table: Expr, given: Sequence[Expr], env: Env) -> Bound | None:
        """Return what a call gives as long as nobody sets a parameter; None for undecided."""
        return self.folder.tables.element_or(table, given, env) if _takes(given, env) else None

    def left(self, entries: Sequence[Entry], key: Expr, env: Env) -> list[Entry] | None:
        """Return the entries without those of a key; None where one may have it."""
        alike = [self._has(entry, key, env) for entry in entries]
        return None if None in alike else [each for each, gone in zip(entries, alike, strict=True) if not gone]

    def _has(self, entry: Entry, key: Expr, env: Env) -> bool | None:
        return self.folder.flow.alike(key, Name("#key"), self.folder.flow.naming(env, {"#key": entry.key}))


def _takes(given: Sequence[Expr], env: Env) -> bool:
    """Whether a call with such arguments, of a statement at a place, is all that takes something out there, once."""
    body = env.func.fact.body
    parts = [part for part, _ in expressions(body[env.at])] if 0 <= env.at < len(body) else []
    pops = [part for part in parts if isinstance(part, Call) and last_of(part.callee) == POP]
    once = len(pops) == 1 and not any(isinstance(part, Comprehension | Lambda) for part in parts)
    return once and env.func.file.language == "python" and 1 <= len(given) <= 2
