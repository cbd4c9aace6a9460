"""What modules ask of the graph: subscribers, publishers, clients, transforms, and the types that they speak."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from ecm_checker.contract import Interface
from ecm_checker.finding import Certainty
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.roles import roles

from ecm_extract.entities.endpoints import comparable_name
from ecm_extract.link.linker import LinkedModule
from ecm_extract.requires.place import Place, required

_ITS_OWN: Final = "~"
"""Owner of a private name of a node that no source names."""
_LOOKUP: Final = " <- "
"""Between the frames of a transform that is looked up."""


def endpoint_requirements(modules: Sequence[LinkedModule]) -> Iterator[Requirement]:
    """Yield what the endpoints of the modules of a package require; a line that several share requires once."""
    seen: set[tuple[str, str, str, int]] = set()
    for module in modules:
        by = f"{module.module.kind} {module.module.name}"
        for entry in module.interfaces:
            at = entry.evidence[0]
            for found in _of(entry, Place(at.path, at.line, by), module.node):
                mark = (found.use, found.name, at.path, at.line)
                if mark not in seen:
                    seen.add(mark)
                    yield found


def _of(entry: Interface, place: Place, node: str | None) -> Iterator[Requirement]:
    row = roles()[entry.role]
    under = {"when": entry.when, "conditions": tuple(each.text for each in entry.when)}
    if row.use:
        name = entry.name if entry.name.startswith("/") else comparable_name(entry)
        owner = (node or _ITS_OWN) if entry.raw_name.startswith("~") else ""
        yield required(row.use, name, place, _certainty(entry), owner=owner, type=entry.type, qos=entry.qos, **under)
    if row.verb and entry.type is not None:
        yield required("speaks", entry.type, place, "likely", said=f"{row.verb} {entry.name}")
    if row.hears_transforms and entry.frame:
        for name in entry.frame.split(_LOOKUP):
            yield required("looks_up", name, place, "likely", **under)


def _certainty(entry: Interface) -> Certainty:
    """A peer that is published to may come from anywhere; a computed name may be any."""
    if entry.confidence == "pattern":
        return "unknown"
    certain = entry.confidence in {"literal", "folded"} and entry.type is not None and not entry.row.writes
    return "proved" if certain else "likely"
