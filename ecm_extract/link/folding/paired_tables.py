"""Tables of Python that are made of pairs: `dict([("a", 1)])`, `OrderedDict(zip(names, topics))`.

Source: docs.python.org, built-in types (`dict`) and "collections".
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr

from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAKERS: Final = frozenset({"dict", "collections.OrderedDict"})
"""Classes whose objects are made of a table, or of pairs, and of what is given by name."""


def pairs_of(expr: Expr, env: Env, folder: Folder) -> list[tuple[Bound, Bound]] | None:
    """Return the keys and values of pairs that a list has; None where not all of them are known."""
    rows = [folder.lists.items(row.expr, row.env) for row in folder.lists.items(expr, env) or ()]
    found = [(row[0], row[1]) for row in rows if row is not None and len(row) == 2]
    return found if rows and len(found) == len(rows) else None
