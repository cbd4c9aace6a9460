"""What remaps and node names of launch files do to the names that programs use."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property

from ecm_checker.hub.kinds import kinds
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.roles import endpoint_kinds, endpoint_uses
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.spelling import graph_name_matches

from ecm_extract.diff.model import Located


class Remaps:
    """The remaps and node names that the launch files of consumers give."""

    def __init__(self, consumers: Iterable[Consumer]) -> None:
        self._requirements = [entry for consumer in consumers for entry in consumer.requirements]

    def lead_elsewhere(self, requirement: Requirement, package: str) -> bool:
        """Whether a launch file gives or connects the name that a program uses: then that line breaks, or nothing."""
        if kinds()[requirement.kind].runs:
            return requirement.name in self._nodes
        if requirement.use not in endpoint_uses():
            return False
        return any(each.package == package and _is_own(each.name, requirement.name) for each in self._remaps)

    def keep_alive(self, located: Located) -> bool:
        """Whether a remap joins the old and the new name of a topic or service."""
        change = located.change
        if change.kind not in endpoint_kinds() or not change.old or not change.new:
            return False
        return any(_joins(change.old, change.new, remap) for remap in self._remaps)

    @cached_property
    def _remaps(self) -> Sequence[Requirement]:
        return [entry for entry in self._requirements if entry.row.leads]

    @cached_property
    def _nodes(self) -> frozenset[str]:
        return frozenset(entry.name for entry in self._requirements if entry.row.names_it)


def _is_own(remapped: str, used: str) -> bool:
    """Whether a remap is of a name that its program uses; a private one may be told below the name of the node."""
    private = remapped.startswith("~") and graph_name_matches(remapped, used)
    return private or _bare(remapped) == _bare(used)


def _joins(old: str, new: str, remap: Requirement) -> bool:
    forth = _means(old, remap.name) and _means(new, remap.target)
    return forth or (_means(old, remap.target) and _means(new, remap.name))


def _means(offered: str, used: str) -> bool:
    return _bare(offered) == _bare(used) or graph_name_matches(offered, used)


def _bare(name: str) -> str:
    return name.lstrip("~/")
