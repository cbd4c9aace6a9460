"""Which module offers now what a module offered that is gone: its node, else the one with most of its names."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Final

from ecm_checker.hub.provision import HOLE, Provision

from ecm_extract.diff.model import Pair
from ecm_extract.diff.nodes import Successions

_LEAST_SHARED: Final = 2
_MOST: Final = 0.5
Module = tuple[str, str]
"""Package and owner."""
Offer = tuple[str, str, str]
"""Kind, facet and bare name of what a module offers."""


def module_homes(pairs: Iterable[Pair]) -> dict[Module, Module]:
    """Return package and owner of the endpoints of each node by what they were."""
    found = {}
    for pair in pairs:
        old, new = pair.old, pair.new
        if old is not None and new is not None and old.row.runs and old.node and new.node:
            found[old.package, old.node] = new.package, new.node
    return found


def likely_homes(old: Iterable[Provision], new: Iterable[Provision], known: Successions) -> dict[Module, Module]:
    """Return, of each module that is gone, the new one of its package that offers most of what it offered.

    One that stood beside it before is another module, unless the files that declare the names are the same. One of its
    own name that came in another package is it, too.
    """
    before, after = _offers(old, known.files), _offers(new, {})
    found = {}
    for module, names in before.items():
        package = known.packages.get(module[0], module[0])
        if (package, module[1]) in after:
            continue
        rated = [
            (len(_shared(names, others, beside=other in before)), other)
            for other, others in after.items()
            if other[0] == package or (other[1] == module[1] and other not in before)
        ]
        count, home = max(rated, default=(0, module))
        if count >= _LEAST_SHARED and count >= len(names) * _MOST:
            found[module] = home
    return found


def _offers(entities: Iterable[Provision], files: Mapping[str, str]) -> dict[Module, dict[Offer, str]]:
    """The file of each name that a module offers."""
    found: dict[Module, dict[Offer, str]] = defaultdict(dict)
    for entity in entities:
        if entity.is_of_module and not entity.name.startswith(HOLE):
            bare = entity.name.lstrip("~/").replace("/", ".")
            for owner in (entity.owner, *entity.sharers):
                offer = entity.kind, entity.facet, bare
                found[entity.package, owner][offer] = files.get(entity.path, entity.path)
    return found


def _shared(names: Mapping[Offer, str], others: Mapping[Offer, str], beside: bool) -> set[Offer]:
    return {name for name, path in names.items() if name in others and (not beside or others[name] == path)}


def names_after(entity: Provision) -> tuple[str, ...]:
    """The names that an old name can have on the other side.

    A private parameter of ROS 1 (`~/turbo/steps`) is a parameter of the node in ROS 2 (`turbo.steps`).
    """
    if not entity.is_value or entity.ros != 1:
        return (entity.name,)
    own = entity.name.removeprefix("~/")
    return entity.name, own, own.replace("/", ".")


def is_ported(old: Provision, new: Provision) -> bool:
    """Whether a name that differs does so since it is of the other generation of ROS."""
    return old.name == new.name or (old.ros, new.ros) == (1, 2)
