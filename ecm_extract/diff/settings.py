"""What the parameter files of a package set: another value, none any more, or one for the first time.

A setting is judged where its file is on both sides; one of a file that came or went is no change of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ecm_checker.hub.provision import Key, Provision

from ecm_extract.diff.model import Pair
from ecm_extract.diff.named_controllers import controller_pairs


class SettingFiles:
    """The parameter files of both sides.

    Attributes:
        moved: new path of each file that moved, by its old one.
    """

    def __init__(self, old: Mapping[Key, Provision], new: Mapping[Key, Provision], moved: Mapping[str, str]) -> None:
        self._moved = moved
        self._new = new
        before = {self._now(entity) for entity in old.values() if entity.row.sets}
        self._both = before & {entity.path for entity in new.values() if entity.row.sets}

    def pairs(self, old: Iterable[Provision], new: Iterable[Provision]) -> Iterator[Pair]:
        """Yield settings of files that moved, or whose package has another name, with what they became."""
        after = {(entity.path, entity.name): entity for entity in new if entity.row.sets}
        left = []
        for entity in old:
            found = after.pop((self._now(entity), entity.name), None) if entity.row.sets else None
            if found is not None:
                yield Pair(entity, found)
            elif entity.row.sets and not self.is_one_sided(entity, old=True):
                left.append(entity)
        yield from controller_pairs(left, after.values(), self._new.values(), self._now)

    def is_one_sided(self, setting: Provision, old: bool) -> bool:
        """Whether the file of a setting is not on the other side."""
        return (self._now(setting) if old else setting.path) not in self._both

    def _now(self, entity: Provision) -> str:
        return self._moved.get(entity.path, entity.path)
