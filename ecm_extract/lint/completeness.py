"""What a run of lint has not read, and whether its answer is therefore not of the whole."""

from __future__ import annotations

from typing import Final

import msgspec

from ecm_extract.diff.model import Comparison
from ecm_extract.diff.unread import UnreadPart
from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree import Unread, unread_of
from ecm_extract.tree.unread import ON_PURPOSE, Reason, is_gap

_OF_RULES: Final[frozenset[Reason]] = frozenset({"unjudged", "stopped"})
"""What the rules leave out, which no comparison knows."""


class Completeness(msgspec.Struct, frozen=True):
    """What was not read, and whether more could be found in it.

    A submodule that is not here, or what the project leaves out, is told and asks for nothing: it is no part of the
    tree under lint. What a comparison with a base has not read of either side is; what the change itself leaves out is
    reported as removed.
    """

    complete: bool
    unread: tuple[Unread | UnreadPart, ...]


def completeness_of(workspace: Workspace, comparison: Comparison | None) -> Completeness:
    """Return what was not read of the tree under lint, and of its base where it has one."""
    unread = unread_of(workspace.tree.diagnostics)
    if comparison is not None:
        gaps = [part for part in comparison.unread if part.limits and part.reason not in ON_PURPOSE]
        compared = {(part.reason, part.path) for part in comparison.unread}
        own = [each for each in unread if each.reason in _OF_RULES and (each.reason, each.path) not in compared]
        return Completeness(not gaps and not own, (*comparison.unread, *own))
    return Completeness(not any(map(is_gap, unread)), unread)
