"""Fields of a variable of C++ that is declared without a value: what their class begins them with, till they change."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Member, Name

from ecm_extract.link.folding.constructions import makers_of
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, demoted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def begun_field(expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return what a field of `Config config;` is there; empty of other objects, and of what nothing begins."""
    if not isinstance(expr.base, Name) or env.func.file.language != "cpp":
        return ()
    helds = {held for way in folder.flow.ways(expr.base, env) for held in way}
    cls = folder.objects.class_of(expr.base, env) if helds and all(held.how == "made" for held in helds) else None
    field = cls.fields.get(expr.name) if cls is not None and not cls.fact.bases and not makers_of(cls) else None
    if field is None or field.default is None:
        return ()
    return demoted(folder.fold(field.default, Env(env.func, depth=env.depth + 1, this=cls)))
