"""Which class of the line of an object has a method: its own class first, then its bases as Python looks them up."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.overloads import fitting
from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program


def nearest(call: Invocation, owners: Sequence[Cls]) -> Sequence[Func]:
    """Return the methods of the first of some classes that has any which fit a call."""
    found = (fitting(call, [func for func in owner.called if func.fact.name == call.last]) for owner in owners)
    return next((funcs for funcs in found if funcs), ())


def behind(own: Cls, this: Cls, program: Program) -> Sequence[Cls]:
    """Return the classes that `super()` means in a class, of an object of another one that derives from it."""
    lineage = program.ancestry(this)
    lineage = lineage if own in lineage else program.ancestry(own)
    return lineage[lineage.index(own) + 1 :]


def ahead(own: Cls, program: Program) -> Sequence[Cls]:
    """Return the classes that objects are asked by before one of their bases: that derive from it, or stand before it.

    Of `class Demo(Mixin, Base)` what `Mixin` has counts before what `Base` has; that is so of Python alone.
    """
    derived = program.derived(own)
    if own.file.language != "python":
        return derived
    lines = (program.ancestry(each) for each in derived)
    return list(dict.fromkeys(each for line in lines for each in line[: line.index(own) if own in line else 1]))
