"""Launch files of packages by their paths: what includes hand each, what it needs and substitutes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.requirement import Given, Requirement

from ecm_extract.entities.launch_values import FILE, NAMED, NEEDED, VALUE, is_judged
from ecm_extract.lint.known import Asked, Known
from ecm_extract.requires.launch_values import SUBSTITUTES

File = tuple[str, str]
"""A package, and a path from its folder."""


class Handing(msgspec.Struct, frozen=True):
    """An include: the file that it stands in, the one that it names, and its line."""

    user: File
    target: File
    given: Given
    place: Evidence


class LaunchArguments:
    """What files have; of two that say the same the first line counts.

    Attributes:
        places: the files with their ROS version. needed: values that an include must hand, with their lines.
        named: names of the values that a file has. substituted: what it substitutes without a default.
        includes: those of the packages under lint whose target is known. into: all by their target.
    """

    def __init__(self, known: Known) -> None:
        self.places: dict[File, int | None] = {}
        self.needed: dict[File, dict[str, Evidence]] = defaultdict(dict)
        self.named: dict[File, set[str]] = defaultdict(set)
        self.substituted: dict[File, dict[str, Requirement]] = defaultdict(dict)
        self._provided(known)
        for package in known.packages.by_name.values():
            for row in package.requires:
                if row.use == SUBSTITUTES:
                    self.substituted[package.name, row.owner].setdefault(row.name, row)
        self.includes = [_handing(each) for each in known.asked("includes_launch") if self._is_told(each)]

    def _provided(self, known: Known) -> None:
        for package in known.packages.by_name.values():
            for row in package.provides:
                if row.kind == FILE:
                    self.places[package.name, row.name] = row.ros
                elif row.kind == VALUE and row.facet == NEEDED:
                    self.needed[package.name, row.owner][row.name] = row.evidence[0]
                elif row.kind == VALUE and row.facet == NAMED:
                    self.named[package.name, row.owner].add(row.name)

    def _is_told(self, asked: Asked) -> bool:
        return asked.requirement.certainty != "unknown" and is_judged(asked.path)

    @property
    def into(self) -> Mapping[File, Sequence[Handing]]:
        """The includes of each file."""
        found: dict[File, list[Handing]] = defaultdict(list)
        for each in self.includes:
            found[each.target].append(each)
        return found

    def of_one_version(self) -> Iterator[tuple[int, Handing]]:
        """Yield includes between known files of the same ROS version, with it."""
        for each in self.includes:
            version = self.places.get(each.target)
            if version is not None and version == self.places.get(each.user):
                yield version, each


def _handing(asked: Asked) -> Handing:
    wanted = asked.requirement
    user = (asked.consumer.name, asked.consumer.inside(asked.path))
    return Handing(user, (wanted.package or "", wanted.target), wanted.given or Given(), wanted.evidence[0])
