"""Endpoints whose name one side computes: what its pattern fits is not gone, only written otherwise."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable

from ecm_checker.gaps import with_gaps
from ecm_checker.hub.provision import HOLE, Provision

_LEAST_KNOWN = 4
"""Letters that a pattern must show: `<*>/a` fits half of all names."""
_ANYWHERE = f"/{HOLE}/"
"""What a handle of a namespace that is not known puts before a name: that of the node, any other, or none."""


class Computed:
    """New endpoints, to be asked for the one that an old name lives on in."""

    def __init__(self, new: Iterable[Provision]) -> None:
        self._index: dict[tuple[str, str, str], list[Provision]] = defaultdict(list)
        for entity in new:
            if entity.is_endpoint:
                self._index[entity.kind, entity.package, entity.facet].append(entity)

    def home(self, old: Provision, package: str, owner: str) -> Provision | None:
        """Return the endpoint of its module or file, and of the same type, that may have this very name.

        `package` and `owner` are those that its module has now.
        """
        for entity in self._index.get((old.kind, package, old.facet), ()):
            near = entity.owner == owner or entity.path == old.path
            if near and entity.type == old.type and may_be_one(old.name, entity.name):
                return entity
        return None


def may_be_one(one: str, other: str) -> bool:
    """Whether the computed parts of two names can stand for what the other has there; two with such show the same."""
    if HOLE in one and HOLE in other:
        return len(_known(one)) >= _LEAST_KNOWN and _known(one) == _known(other)
    if HOLE not in one and HOLE not in other:
        return False
    pattern, name = (one, other) if HOLE in one else (other, one)
    if len(_known(pattern)) < _LEAST_KNOWN:
        return False
    anywhere = pattern.startswith(_ANYWHERE)
    fixed = [re.escape(part) for part in pattern.removeprefix(_ANYWHERE).lstrip("~/").split(HOLE)]
    below = "(?:.*/)?" if anywhere else ""
    return re.fullmatch(below + with_gaps(fixed, ".+"), name.lstrip("~/")) is not None


def _known(pattern: str) -> list[str]:
    """The letters that a pattern shows."""
    return re.findall(r"\w", pattern.replace(HOLE, ""))
