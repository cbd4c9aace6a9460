"""Modules of which one became the other, and what may be of another module than it was."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.model import Pair
from ecm_extract.diff.moves import is_of_its_node
from ecm_extract.diff.similarity import last_part


def kin(pairs: Iterable[Pair]) -> Iterator[tuple[str, str]]:
    """Owners of which one became the other; that another node has a channel of a graph now says nothing of nodes."""
    for pair in pairs:
        old, new = pair.old, pair.new
        if old is not None and new is not None and not (pair.how == "moved" and old.is_endpoint):
            yield old.owner, new.owner


def may_be_of(old: Provision, new: Provision) -> bool:
    """Whether it may be of another module than it was: a channel that is called so in its place, and not by a node."""
    if not old.is_endpoint or is_of_its_node(old, new):
        return not old.is_of_module
    return last_part(old.name) == last_part(new.name)
