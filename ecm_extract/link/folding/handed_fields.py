"""Fields of objects of Python behind the functions that the objects were handed to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Member

from ecm_extract.infer.held import Held
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, alternatives, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def handed_field(expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return what a field is that a function may have changed which was handed the object; empty where none was."""
    if env.func.file.language != "python":
        return ()
    helds = list(dict.fromkeys(held for way in folder.flow.ways(expr.base, env) for held in way))
    if all(held.how != "out" for held in helds):
        return ()
    return alternatives([value for held in helds for value in _left(held, expr, env, folder)])


def _left(held: Held, expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """What a function leaves a field with: what it gives it, else what the field was where it was called."""
    if held.how != "out" or held.env is None:
        return (unknown(expr.name),)
    before = (Held("value", expr.name, expr, held.env),)
    left = folder.behind_calls.out(
        Held("out", f"{held.name}.{expr.name}", held.expr, held.env, held.at, before=before), held.env
    )
    if left is None:
        return (unknown(expr.name),)
    return folder.held.of([left[0]], left[1].deeper(env.depth + 1))
