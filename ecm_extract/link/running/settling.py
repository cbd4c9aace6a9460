"""Facts that one file alone cannot tell, read again as the whole tree says, before anything is run."""

from __future__ import annotations

from functools import partial

from ecm_extract.link.code.units import File
from ecm_extract.link.index.contexts import settle_contexts
from ecm_extract.link.index.implied_ends import settle_implied_ends
from ecm_extract.link.index.implied_makers import settle_implied_makers
from ecm_extract.link.index.program import Program
from ecm_extract.link.index.wrapped import settle_wrapped
from ecm_extract.link.running.bound_methods import settle_bound_methods
from ecm_extract.link.running.cast_objects import settle_casts
from ecm_extract.link.running.in_order import Place, settle_order
from ecm_extract.link.running.members_of_bases import settle_members_of_bases
from ecm_extract.link.running.objects import Objects
from ecm_extract.link.running.scope import Scope
from ecm_extract.tree import FileDiagnostic, Unread, printable


def settle(program: Program) -> tuple[FileDiagnostic, ...]:
    """Read members of casts and of several classes, pointers to methods, contexts, what stands around functions.

    Returns what is to be told of statements that are not read as they run.
    """
    for file in program.files:
        file.returned = partial(_returned, program, file)
    settle_casts(program)
    settle_implied_makers(program)
    settle_implied_ends(program)
    settle_members_of_bases(program)
    settle_bound_methods(Objects(program, Scope(program)))
    settle_contexts(program)
    settle_wrapped(program)
    return tuple(_told(place) for place in settle_order(program))


def _returned(program: Program, file: File, name: str, scope: str) -> frozenset[str]:
    """What the functions of a file's sight return that a name means."""
    return frozenset(func.fact.returns for func in program.functions_named(name, file, scope))


def _told(place: Place) -> FileDiagnostic:
    path = printable(place.path)
    text = (
        "The parts of this statement are too many to be put in the order in which they run: what one of them changes "
        "may be told as it was before; split the statement."
    )
    return FileDiagnostic("warning", "values-left-out", path, place.line, text, Unread(path, "unfollowed"))
