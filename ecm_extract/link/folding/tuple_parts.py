"""`std::get<1>(pair)` of C++: an element of a tuple by its place."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Member

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.containers import PAIR
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, demoted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_GET: Final = "std::get"


def part_by_place(call: Invocation, env: Env, folder: Folder) -> tuple[Value, ...] | None:
    """Return what such a call gives; None for other calls."""
    at = call.types[0] if call.path == _GET and len(call.args) == len(call.types) == 1 else ""
    tuple_ = call.args[0] if at.isdigit() else None
    if tuple_ is None or any(folder.flow.ways(Member(tuple_, name), env) for name in PAIR):
        return None
    parts = folder.structures.parts(tuple_, env)
    if parts is None or int(at) >= len(parts):
        return None
    bound = parts[int(at)]
    return demoted(folder.fold(bound.expr, bound.env.deeper(env.depth + 1)))
