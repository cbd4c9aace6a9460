"""All public entities of a tree."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import msgspec
from ecm_checker.hub.provision import Key, Provision
from ecm_checker.json_data import json_data

from ecm_extract.entities.announced import announced
from ecm_extract.entities.bt_nodes import Port, base_ports, bt_entities
from ecm_extract.entities.cpp import cpp_entities
from ecm_extract.entities.descriptions import description_entities
from ecm_extract.entities.endpoints import endpoint_entities
from ecm_extract.entities.interfaces import interface_entities
from ecm_extract.entities.launch import launch_entities, launch_files
from ecm_extract.entities.launch_parameters import launch_parameters
from ecm_extract.entities.naming import at_their_names
from ecm_extract.entities.nodes import node_entities
from ecm_extract.entities.packaging import packaging_entities
from ecm_extract.entities.parameter_settings import parameter_settings
from ecm_extract.entities.python import python_entities
from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.entities.transforms import transform_entities
from ecm_extract.entities.written_lines import with_lines
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts

if TYPE_CHECKING:
    from ecm_extract.entities.workspace import Workspace


def public_entities(workspace: Workspace) -> dict[Key, Provision]:
    """Return the entities of all packages by key; of two with one key the first by path and line stays."""
    tree, packages, texts = workspace.tree, workspace.packages, workspace.texts
    modules = _by_package(workspace.linked)
    ports = base_ports(packages)
    every = [entity for facts in packages for entity in _of_package(texts, facts, modules[facts.name], ports)]
    placed = announced(texts, packages, at_their_names(every))
    return _by_key(with_lines(tree, placed), packages)


def graph_entities(packages: Sequence[PackageFacts], linked: Sequence[LinkedModule]) -> dict[Key, Provision]:
    """Return the topics, services and actions of all packages by key, without what their files say of their end."""
    modules = _by_package(linked)
    every = [each for facts in packages for each in endpoint_entities({}, facts, modules[facts.name])]
    return _by_key(at_their_names([each for each in every if each.is_endpoint]), packages)


def _by_package(linked: Sequence[LinkedModule]) -> dict[str, list[LinkedModule]]:
    modules: dict[str, list[LinkedModule]] = defaultdict(list)
    for entry in linked:
        modules[entry.module.package].append(entry)
    return modules


def _by_key(entities: Iterable[Provision], packages: Sequence[PackageFacts]) -> dict[Key, Provision]:
    found: dict[Key, Provision] = {}
    for entity in sorted(entities, key=lambda e: (e.package, e.path, e.line)):
        known = found.get(entity.key)
        found[entity.key] = _plain(entity) if known is None else _joined(known, entity)
    return _at_home(found, packages)


def _plain(entity: Provision) -> Provision:
    """With the default as documents hold it, so that one that is read off sources equals one that was stored."""
    if entity.default is None or type(entity.default) is str:
        return entity
    return msgspec.structs.replace(entity, default=json_data(entity.default))


def _joined(first: Provision, other: Provision) -> Provision:
    """The first of two with one key; overloads that stand in several headers are all its forms.

    A channel or parameter that has one type or another has both; what is there in two ways needs the conditions of
    neither.
    """
    if first.when != other.when:
        first = msgspec.structs.replace(first, when=())
    if first.is_of_module and other.type is not None and other.type not in {first.type, *first.others}:
        return msgspec.structs.replace(first, others=(*first.others, other.type))
    if not first.forms or not other.forms or first.path == other.path:
        return first
    forms = {(form.types, form.returns): form for form in (*other.forms, *first.forms)}
    ordered = tuple(sorted(forms.values(), key=lambda form: (form.types, form.returns)))
    return msgspec.structs.replace(first, forms=ordered)


def _at_home(found: dict[Key, Provision], packages: Sequence[PackageFacts]) -> dict[Key, Provision]:
    """Drop the views that other packages have of a declaration which its own package offers."""
    home = {path: facts.name for facts in packages for path in facts.sources}
    offered = {_line(entity) for entity in found.values() if home.get(entity.path) == entity.package}
    return {
        key: entity
        for key, entity in found.items()
        if entity.row.own_copy  # each node has the ports of its base for itself
        or home.get(entity.path) in {None, entity.package}
        or _line(entity) not in offered
    }


def _line(entity: Provision) -> tuple[str, str, str, str, int]:
    return entity.kind, entity.facet, entity.name, entity.path, entity.line


def _of_package(
    texts: SideTexts, facts: PackageFacts, modules: list[LinkedModule], ports: dict[str, list[Port]]
) -> Iterator[Provision]:
    yield from packaging_entities(texts, facts)
    yield from interface_entities(facts)
    yield from endpoint_entities(texts.speaking, facts, modules)
    yield from node_entities(facts, modules)
    yield from transform_entities(facts, modules)
    yield from cpp_entities(facts)
    yield from python_entities(facts)
    yield from bt_entities(facts, ports)
    launches = launch_files(texts, facts)
    yield from launch_entities(facts, launches)
    yield from parameter_settings(texts, facts, launches)
    yield from launch_parameters(facts, launches)
    yield from description_entities(texts, facts)
