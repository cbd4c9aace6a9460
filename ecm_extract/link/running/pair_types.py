"""Types of the parts of pairs of C++: of those that are declared, and of those that a loop over a map gives."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Member, Name

from ecm_extract.link.code.containers import looped_type, part_of_pair
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.running.objects import Objects


def type_in_pair(expr: Member, env: Env, objects: Objects) -> str:
    """Return the type of `pair.first` or `pair.second`; empty of other objects."""
    given = isinstance(expr.base, Name) and not objects.scope.declared_type(expr.base.id, env)
    whole = objects.assigned_type(expr.base.id, env, looped_type) if given and isinstance(expr.base, Name) else ""
    return part_of_pair(whole or objects.type_of(expr.base, env), expr.name)
