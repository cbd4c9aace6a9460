"""Remaps of launch files: they connect nodes, whatever the names in their programs are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from ecm_parsers.launch.model import Action, Group, Node, Remap, Template

from ecm_extract.diff.model import Located
from ecm_extract.entities.launch import launch_files
from ecm_extract.entities.model import PublicEntity
from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at
from ecm_extract.uses.names import graph_name_matches

_KINDS: Final = ("topic", "service", "action")
_COMPUTED: Final = "{}"


@dataclass(frozen=True, slots=True)
class Connection:
    """One remap: the name that a program has, the name that it gets.

    Attributes:
        package: of the program; empty for a remap of a whole scope.
        place: of the remap.
    """

    source: str
    target: str
    package: str
    place: Place


def connections_of(workspace: Workspace) -> list[Connection]:
    """Return the remaps of all launch files of a workspace; a substitution in a name is `{}`."""
    return [
        connection
        for facts in workspace.packages
        for path, file in launch_files(workspace.tree, facts)
        for connection in _connections(file.actions, Place(facts.name, path, 1))
    ]


def _connections(actions: Iterable[Action], place: Place) -> Iterator[Connection]:
    for action in actions:
        if isinstance(action, Remap):
            yield _connection(action, "", place)
        elif isinstance(action, Group):
            yield from _connections(action.actions, place)
        elif isinstance(action, Node):
            package = _written(action.package) or _written(action.plugin).replace("::", "/").partition("/")[0]
            yield from (_connection(remap, package, place) for remap in action.remaps)
            yield from _connections(action.components, place)


def _connection(remap: Remap, package: str, place: Place) -> Connection:
    at = Place(place.package, place.path, remap.line)
    return Connection(_written(remap.source), _written(remap.target), package, at)


def _written(template: Template) -> str:
    return "".join(part if isinstance(part, str) else _COMPUTED for part in template)


def remap_uses(connections: Sequence[Connection], index: ChangeIndex) -> Iterator[Use]:
    """Yield the remaps of a name that a provider no longer has, and those that lead to it."""
    for kind in _KINDS:
        for located in index.of_kind(kind):
            entity = located.pair.old
            if entity is not None and located.change.change in GONE:
                yield from _of_entity(connections, located, entity, index)


def _of_entity(
    connections: Sequence[Connection], located: Located, entity: PublicEntity, index: ChangeIndex
) -> Iterator[Use]:
    offered = list(index.offered(entity.kind, entity.facet))
    for each in connections:
        name = each.source if each.package == entity.package else each.target
        if not name or not means(entity.name, name) or any(means(other.name, name) for other in offered):
            continue
        if each.package == entity.package:
            yield use_at(located, each.place, f"remaps {each.source}")
        elif each.package:
            yield use_at(located, each.place, f"remaps {each.source} to {each.target}", "likely")


def is_led_elsewhere(package: str, used: str, connections: Iterable[Connection]) -> bool:
    """Whether a launch file connects the name that a program uses: then the remap is what breaks, or nothing.

    Args:
        package: of the program.
        used: the name that it has.
        connections: of the workspace.
    """
    own = [each for each in connections if each.package == package and _bare(each.source) == _bare(used)]
    return bool(own) and all(_bare(each.target) != _bare(used) for each in own)


def is_kept_alive(use: Use, connections: Iterable[Connection]) -> bool:
    """Whether a remap joins the old and the new name of the topic or service that a use needs."""
    change = use.located.change
    if change.kind not in _KINDS or not change.old or not change.new:
        return False
    names = (change.old, change.new)
    return any(
        _joins(names, each.source, each.target) or _joins(names, each.target, each.source) for each in connections
    )


def _joins(names: tuple[str, str], one: str, other: str) -> bool:
    return all(means(offered, used) for offered, used in zip(names, (one, other), strict=True))


def means(offered: str, used: str) -> bool:
    """Whether a name of a launch file is one that a provider offers."""
    return _bare(offered) == _bare(used) or graph_name_matches(offered, used)


def _bare(name: str) -> str:
    return name.lstrip("~/")
