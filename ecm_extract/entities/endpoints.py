"""Topics, services, actions, parameters and frames that modules offer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import msgspec
from ecm_checker.contract import Interface
from ecm_checker.hub.provision import HOLE, Line, Provision
from ecm_checker.hub.roles import roles

from ecm_extract.entities.deprecations import deprecated_names
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts

_HOLE = re.compile(r"\{[^{}]*\}")
_NAME = re.compile(r"[\w~/.-]*")


def endpoint_entities(
    speaking: Mapping[str, bytes], facts: PackageFacts, modules: Sequence[LinkedModule]
) -> Iterator[Provision]:
    """Yield what the modules of a package offer; an endpoint that several of them share is given once.

    `speaking` are the contents of files that may tell the end of one, by path.
    """
    paths = {at.path for module in modules for entry in module.interfaces for at in entry.evidence[:1]}
    deprecated = deprecated_names(speaking, paths & set(facts.sources))
    shared: dict[tuple[str, str, str, str, int], Provision] = {}
    for module in modules:
        for entry in module.interfaces:
            found = entity_of(entry, facts.name, module.module.name, facts.ros)
            if found is None:
                continue
            bare = found.name.lstrip("~/")
            told = deprecated.get(bare) or deprecated.get(found.name)
            found = msgspec.structs.replace(found, node=module.node or _node_of(entry), deprecated=told)
            if found.path.endswith(".cfg") and facts.ros == 2:
                continue  # dynamic_reconfigure is of ROS 1: a port left the file behind
            mark = (found.kind, found.facet, found.name, found.path, found.line)
            first = shared.setdefault(mark, found)
            if first is not found:
                when = first.when if first.when == found.when else ()
                shared[mark] = msgspec.structs.replace(first, sharers=(*first.sharers, found.owner), when=when)
    yield from shared.values()


def entity_of(entry: Interface, package: str, owner: str, ros: int | None) -> Provision | None:
    """Return what a module offers by an endpoint; None for what only asks, and for names that are wholly computed."""
    row = roles()[entry.role]
    name = comparable_name(entry)
    if not row.provides or is_wholly_computed(entry):
        return None
    if row.channel is not None and not _NAME.fullmatch(name.replace(HOLE, "")):
        return None  # the default says that a value must be given: `<undefined>`
    at = entry.evidence[0]
    return Provision(
        kind=row.provides,
        package=package,
        owner=owner,
        name=name,
        facet=row.facet,
        type=entry.type,
        default=entry.default,
        qos=entry.qos,
        ros=ros,
        confidence=entry.confidence,
        path=at.path,
        line=at.line,
        chain=_calls(entry),
        when=entry.when,
        needed=entry.needed,
    )


def is_wholly_computed(entry: Interface) -> bool:
    """Whether no letter of the name of an endpoint is known."""
    return not re.search(r"\w", comparable_name(entry).replace(HOLE, ""))


def _node_of(entry: Interface) -> str | None:
    """The node that a private name hangs below, as a plugin that makes a node of its own tells it."""
    rest = entry.raw_name.lstrip("~/")
    above = entry.name.removesuffix(f"/{rest}").rpartition("/")[2] if entry.name.startswith("/") else ""
    is_told = entry.raw_name.startswith("~") and not entry.row.value and entry.name.endswith(f"/{rest}")
    return above if is_told and above and not _HOLE.search(above) else None


def _calls(entry: Interface) -> tuple[Line, ...]:
    """The calls that lead to an endpoint, its own first; none where it is made by its own module."""
    lines = tuple(dict.fromkeys((place.path, place.line) for place in entry.evidence))
    return lines if len(lines) > 1 else ()


def comparable_name(entry: Interface) -> str:
    """Return a name that survives a change of idiom: private names keep `~`, computed parts are `<*>`."""
    name = entry.name
    if entry.raw_name.startswith("~") and not entry.row.value:
        name = "~/" + entry.raw_name[1:].lstrip("/")
    elif entry.raw_name.startswith("~"):
        name = entry.raw_name[1:].lstrip("/") if entry.name.startswith(("/", "~/")) else entry.name
    return _HOLE.sub(HOLE, name)
