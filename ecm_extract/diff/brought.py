"""Packages whose headers reach a consumer: those that it depends on, and those that these bring along."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ecm_checker.match.consumer import Consumer


class Brought:
    """What depending on packages of the new side brings along.

    Args:
        packages: those of the new side.
    """

    def __init__(self, packages: Sequence[Consumer]) -> None:
        self._packages = packages
        self._known: Mapping[str, frozenset[str]] | None = None

    def reaches(self, consumer: Consumer, package: str) -> bool:
        """Whether a consumer depends on a package, directly or by what it depends on."""
        found = dict.fromkeys(_depends(consumer))
        queue: list[str] = list(found)
        for name in queue:
            fresh = [each for each in self._of(name) if each not in found]
            found.update(dict.fromkeys(fresh))
            queue += fresh
        return package in found

    def _of(self, package: str) -> Iterable[str]:
        if self._known is None:
            self._known = {each.package: frozenset(_depends(each)) for each in self._packages}
        return self._known.get(package, ())


def _depends(consumer: Consumer) -> Iterable[str]:
    return (each.name for each in consumer.requirements if each.row.brings)
