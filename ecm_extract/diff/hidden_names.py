"""What nothing declares by its name any more where names are declared now that are not known.

Parameters of modules that compute names, arguments of launch files that leave their description to others.
"""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.hub.provision import HOLE, Provision

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
        self._unread_before = {_module(each) for each in before if each.row.is_placed and HOLE in each.bases}
        self._unread: dict[Module, Provision] = {}
        for each in new:
            if each.row.is_placed and HOLE in each.bases:
                self._unread[_module(each)] = each
            if each.row.runs and each.open:
                self._open.setdefault(_module(each), each)
            elif each.is_value and each.is_computed and each.key not in known:
                self._patterns.setdefault((each.package, each.owner), []).append(each)

    def holder(self, lost: Provision, module: Module) -> Provision | None:
        """Return what of the new side may be a parameter that is gone, or declare it.

        That is a pattern which came with that side and fits the name, or a node with names of which nothing is known.
        """
        if lost.row.duty and (lost.package, lost.owner) not in self._unread_before:
            return self._unread.get(module)
        if not lost.is_value:
            return None
        fitting = (each for each in self._patterns.get(module, ()) if may_be_one(lost.name, each.name))
        is_new = (lost.package, lost.owner) not in self._open_before
        return next(fitting, self._open.get(module) if is_new else None)


def is_hidden_in(old: Provision, new: Provision) -> bool:
    """Whether a pattern may stand for a parameter as it was called: then that has no other name."""
    return old.is_value and not old.is_computed and new.is_computed and may_be_one(old.name, new.name)


def hiding_files(located: Iterable[Located]) -> tuple[UnreadPart, ...]:
    """Return the files of what may still have what is gone under names that are not known."""
    paths = {entry.pair.hidden_in.path for entry in located if entry.pair.hidden_in is not None}
    return tuple(UnreadPart(path, "unfollowed", True, "new", True) for path in sorted(paths))


def _module(node: Provision) -> Module:
    return node.package, node.node or node.owner or node.name
