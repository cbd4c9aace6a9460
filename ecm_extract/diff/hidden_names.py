"""Parameters that nothing declares by their name any more, in modules that now declare some by names not known."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.computed import may_be_one
from ecm_extract.diff.model import Located
from ecm_extract.diff.unread import UnreadPart

Module = tuple[str, str]
"""Package and owner of what a module declares."""


class HiddenNames:
    """What the declarations of the new side may stand for whose names are computed there, and were not before."""

    def __init__(self, old: Iterable[Provision], new: Iterable[Provision]) -> None:
        before = list(old)
        known = {each.key for each in before}
        self._open_before = {_module(each) for each in before if each.row.runs and each.open}
        self._open: dict[Module, Provision] = {}
        self._patterns: dict[Module, list[Provision]] = {}
        for each in new:
            if each.row.runs and each.open:
                self._open.setdefault(_module(each), each)
            elif each.is_value and each.is_computed and each.key not in known:
                self._patterns.setdefault((each.package, each.owner), []).append(each)

    def may_be_there(self, lost: Provision, module: Module) -> bool:
        """Whether a pattern that came with the new side shows enough of a name to be the one that is gone."""
        return lost.is_value and any(may_be_one(lost.name, each.name) for each in self._patterns.get(module, ()))

    def node_of(self, lost: Provision, module: Module) -> Provision | None:
        """Return the node of the new side that may declare what is gone under a name of which nothing is known."""
        is_new = lost.is_value and (lost.package, lost.owner) not in self._open_before
        return self._open.get(module) if is_new else None


def hiding_files(located: Iterable[Located]) -> tuple[UnreadPart, ...]:
    """Return the files of nodes that may still have what is gone under names that are not known."""
    nodes = [entry.pair.hidden_in for entry in located if entry.pair.hidden_in is not None]
    return tuple(UnreadPart(path, "unfollowed", True, "new", True) for path in sorted({node.path for node in nodes}))


def _module(node: Provision) -> Module:
    return node.package, node.node or node.owner
