"""Facts that one file alone cannot tell, read again as the whole tree says, before anything is run."""

from __future__ import annotations

from ecm_extract.link.index.contexts import settle_contexts
from ecm_extract.link.index.members_of_bases import settle_members_of_bases
from ecm_extract.link.index.program import Program
from ecm_extract.link.index.wrapped import settle_wrapped


def settle(program: Program) -> None:
    """Read members that are written with their class, contexts, and what stands around functions, as the tree says."""
    settle_members_of_bases(program)
    settle_contexts(program)
    settle_wrapped(program)
