"""Profiles of Python that a named tuple was made with: it keeps them, and they stay as they are if nobody sets them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.python_dataclasses import is_unchangeable

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import last_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_SET: Final = ("depth", "history", "reliability", "durability", "deadline", "lifespan", "liveliness")
"""Policies that can be set on a profile which is made (rclpy/qos.py)."""
_MAKING: Final = frozenset({"QoSProfile", "copy", "deepcopy"})
"""Calls that give a profile which nobody else has."""


def stays(held: Held, folder: Folder) -> bool:
    """Tell whether what a profile was handed to is a named tuple, and nobody sets policies of what others may have."""
    call, place = held.expr, held.env
    if not isinstance(call, Call) or place is None or place.func.file.language != "python":
        return False
    cls = folder.program.class_named(dotted_name(call.callee), place.func.file, place.scope)
    lineage = folder.program.ancestry(cls) if cls is not None else ()
    if not lineage or not all(is_unchangeable(each.fact, each.file.facts.imports) for each in lineage):
        return False
    given = (each for name in _SET for each in folder.scope.assigned_outside(name, "python"))
    return all(_is_own(each.statement.target, each.func) for each in given)


def _is_own(target: Expr | None, func: Func) -> bool:
    """Whether a policy is set on a profile that the function has made for itself."""
    owner = target.base if isinstance(target, Member) else None
    made = [step.value for step in func.fact.body if step.target == owner]
    own = isinstance(owner, Name) and owner.id not in func.given and bool(made)
    return own and all(isinstance(each, Call) and last_of(each.callee) in _MAKING for each in made)
