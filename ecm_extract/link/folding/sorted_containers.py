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
    """Return the elements of a container as a loop over it sees them; those whose keys are not known as they stand."""
    kind = last_name(plain(written_type(container, env.func))) if env.func.file.language == "cpp" else ""
    if found is None or kind not in _SORTED:
        return found
    keyed = [_Element(_key(bound, kind in _OF_PAIRS, folder), bound) for bound in found]
    kinds = {type(each.key) for each in keyed}
    if len(kinds) != 1 or not kinds <= {str, int}:
        return found
    ordered = sorted(keyed if kind in _SEVERAL else _first_of_each(keyed), key=lambda each: each.key)
    return [each.bound for each in ordered]


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
