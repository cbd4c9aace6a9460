"""Methods of Python that are called by their class, with the object as an argument: `Base.reset(part)`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Member

from ecm_extract.infer.effect import Effect

if TYPE_CHECKING:
    from ecm_extract.infer.effects import Effects


def by_class(call: Call, effects: Effects) -> Iterator[Effect]:
    """Yield the object that such a call of a method of the tree may change: not the one at hand, which is followed.

    Args:
        call: any call.
        effects: of the function that calls.
    """
    method = call.callee
    if not isinstance(method, Member) or not call.args or call.args[0] == THIS or not effects.is_of_class(method):
        return
    root = effects.root(call.args[0])
    if root and effects.targets.parameters.changes_by_class(method, effects.func):
        yield Effect("lost", root, call)
