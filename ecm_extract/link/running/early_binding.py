"""Calls of C++ on the object at hand that mean the same whatever its class is: [class.virtual], [class.cdtor]."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, Protocol

from ecm_parsers.source.expr import THIS

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.env import Env

_VIRTUAL: Final = frozenset({"virtual", "override", "pure"})


class Methods(Protocol):
    """Who knows the methods of classes."""

    program: Program

    def methods(self, call: Invocation, cls: Cls | None) -> Sequence[Func]:
        """Return the methods of an object's class, or else of its nearest base, that fit a call."""


def early_bound(call: Invocation, env: Env, known: Methods) -> Sequence[Func]:
    """Return the methods of the class that writes a call: in a constructor, or as they are not virtual; else none."""
    found = known.methods(call, env.func.cls) if _is_own(call, env) else ()
    begins = env.func.is_constructor and not call.statement.deferred  # a lambda of it runs later
    is_bound = begins or not any(is_virtual(each, known.program) for each in found)
    return found if is_bound else ()


def _is_own(call: Invocation, env: Env) -> bool:
    """Whether a call is one of C++ on the object at hand, whose class is another than that of the method."""
    static = env.func.cls
    if static is None or static.file.language != "cpp" or env.this in {None, static}:
        return False
    return (call.receiver == THIS and "::" not in call.path) or (call.receiver is None and call.simple)


def is_virtual(method: Func, program: Program) -> bool:
    """Tell whether derived classes of C++ may have a method of their own in the place of one."""
    lineage = program.ancestry(method.cls) if method.cls is not None else ()
    named = (each for entry in lineage for each in entry.methods if each.fact.name == method.fact.name)
    return any(_VIRTUAL.intersection(each.fact.traits) for each in named)
