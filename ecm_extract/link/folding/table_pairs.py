"""Entries of tables of C++ as a loop over these gives them: `for (auto & [name, value] : table)`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr, Items, Name

from ecm_extract.infer.held import Held, State
from ecm_extract.link.folding.fold_tables import Entry
from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_KEY: Final = "#key"
_VALUE: Final = "#value"


def pairs_of_table(table: Expr, env: Env, folder: Folder) -> list[Bound] | None:
    """Return the entries of a table, each key once; None where they are not all known, or it is none."""
    entries = folder.tables.entries(table, env)
    found = folder.tables.distinct(entries, env) if entries is not None else None
    return [pair_of(entry, env) for entry in found] if found is not None else None


def pair_of(entry: Entry, env: Env) -> Bound:
    """Return a key and its value as one element, though each may be known at a place of its own."""
    parts = ((_KEY, entry.key), (_VALUE, entry.value))
    state = State().having({name: (Held("value", name, part.expr, part.env),) for name, part in parts})
    return Bound(Items((Name(_KEY), Name(_VALUE))), env.within(state, env.at))
