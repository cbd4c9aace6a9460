"""Maps and sets of C++ give what is in them by its order, whoever was put in first.

Source: [associative.reqmts] of the C++ standard.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.texts import written_type
from ecm_extract.link.folding.named_containers import container_of_variable
from ecm_extract.link.folding.table_pairs import pairs_of_table
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import data_in

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_OF_PAIRS: Final = frozenset({"map", "multimap"})
_SORTED: Final = frozenset({"map", "multimap", "set", "multiset"})
_SEVERAL: Final = frozenset({"multimap", "multiset"})


class _Element(NamedTuple):
    key: Any
    bound: Bound


def in_their_order(found: list[Bound] | None, container: Expr, env: Env, folder: Folder) -> list[Bound] | None:
    """Return the elements of a container as a loop over it sees them; those whose keys are not known as they stand.

    Of a table that statements filled they are its entries.
    """
    if env.func.file.language != "cpp":
        return found
    if found is None:
        found = pairs_of_table(container, env, folder)
    kind = _kind(container, env, folder)
    if found is None or kind not in _SORTED:
        return found
    keyed = [_Element(_key(bound, kind in _OF_PAIRS, folder), bound) for bound in found]
    kinds = {type(each.key) for each in keyed}
    if len(kinds) != 1 or not kinds <= {str, int}:
        return found
    ordered = sorted(keyed if kind in _SEVERAL else _first_of_each(keyed), key=lambda each: each.key)
    return [each.bound for each in ordered]


def _kind(container: Expr, env: Env, folder: Folder) -> str:
    """The name of the type of a container, of an alias what that stands for."""
    written = written_type(container, env.func)
    return last_name(plain(container_of_variable(written, env.func, folder.program))) if written else ""


def _first_of_each(keyed: Sequence[_Element]) -> list[_Element]:
    return list({each.key: each for each in reversed(keyed)}.values())


def _key(bound: Bound, is_pair: bool, folder: Folder) -> Any:
    """What an element is sorted by."""
    expr = bound.expr
    if is_pair:
        parts = expr.items if isinstance(expr, Items) else expr.args if isinstance(expr, Call) else ()
        if not parts:
            return UNKNOWN
        expr = parts[0]
    values = folder.fold(expr, bound.env)
    return data_in(values[0]) if len(values) == 1 else UNKNOWN
