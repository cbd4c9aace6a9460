"""Elements that others have, too: a text or a number of Python is nobody's to change, anything else may be changed."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Name

from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.held import Held, State
from ecm_extract.link.running.env import Bound

_ELEMENT: Final = "#element"


def reached(element: Bound) -> Bound:
    """Return an element of which only what nobody can change is as it was."""
    if is_plain(element.expr):
        return element
    before = Held("value", "element", element.expr, element.env)
    state = State().having({_ELEMENT: (Held("handed", "element", before=(before,)),)})
    return Bound(Name(_ELEMENT), element.env.within(state, element.env.at))
