"""Subscribers, publishers and clients whose peer is gone or speaks another type."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_checker.contract import Interface

from ecm_extract.diff.model import Located
from ecm_extract.entities.endpoints import comparable_name
from ecm_extract.entities.model import PublicEntity
from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at
from ecm_extract.uses.names import graph_name_matches
from ecm_extract.uses.remaps import Connection, is_led_elsewhere

_PEERS = {
    "subscriber": ("topic", "published", "subscribes to"),
    "publisher": ("topic", "subscribed", "publishes"),
    "service_client": ("service", "", "calls"),
    "action_client": ("action", "", "calls"),
}


def endpoint_uses(workspace: Workspace, index: ChangeIndex, connections: Sequence[Connection]) -> Iterator[Use]:
    """Yield the endpoints of a workspace that a change leaves without a peer, each line once.

    Args:
        workspace: the consumer.
        index: the changes.
        connections: remaps of its launch files; a name that they lead elsewhere connects nothing by itself.
    """
    seen: set[tuple[str, str, int]] = set()
    for module in workspace.linked:
        for entry in module.interfaces:
            if entry.role not in _PEERS or entry.confidence == "pattern":
                continue
            if is_led_elsewhere(module.module.package, entry.name, connections):
                continue
            for use in _of(entry, module.module.package, index):
                mark = (use.located.change.old or "", use.path, use.line)
                if mark not in seen:
                    seen.add(mark)
                    yield use


def _of(entry: Interface, package: str, index: ChangeIndex) -> Iterator[Use]:
    kind, facet, verb = _PEERS[entry.role]
    used = entry.name if entry.name.startswith("/") else comparable_name(entry)
    for located in index.of_kind(kind):
        entity = located.pair.old
        if entity is None or entity.facet != facet or not _concerns(located, entity, entry):
            continue
        if graph_name_matches(entity.name, used) and not _served(located, entry, used, index):
            at = entry.evidence[0]
            certain = entry.confidence in {"literal", "folded"} and entry.type is not None and facet != "subscribed"
            place = Place(package, at.path, at.line)
            yield use_at(located, place, f"{verb} {used}", "proved" if certain else "likely")


def _concerns(located: Located, entity: PublicEntity, entry: Interface) -> bool:
    """A peer of another type is another topic of the same name; one that has the new type already is right."""
    if located.change.change == "type_changed":
        return entry.type == entity.type
    return located.change.change in GONE and (None in (entry.type, entity.type) or _same(entry.type, entity.type))


def _same(one: str | None, other: str | None) -> bool:
    """The same type; a message that moved to another package keeps its name."""
    return (one or "").rsplit("/", 1)[-1] == (other or "").rsplit("/", 1)[-1]


def _served(located: Located, entry: Interface, used: str, index: ChangeIndex) -> bool:
    """Whether the new side still offers the name that is used."""
    if located.change.change == "type_changed":
        return False
    kind, facet, _ = _PEERS[entry.role]
    return any(graph_name_matches(entity.name, used) for entity in index.offered(kind, facet))
