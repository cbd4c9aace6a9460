"""Provides and requires of each package of a linked tree."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence

import msgspec
from ecm_checker.hub.package import Hub, provided
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.running import Running
from ecm_checker.json_data import json_data

from ecm_extract.entities.collect import public_entities
from ecm_extract.entities.inner import InnerNames
from ecm_extract.entities.interfaces import interface_name
from ecm_extract.entities.launch import launch_files
from ecm_extract.entities.listed import listed
from ecm_extract.entities.notes import read_notes
from ecm_extract.entities.python import bound_names, quoted_names
from ecm_extract.entities.told_of_build import Surroundings, surroundings, told_of_build
from ecm_extract.entities.workspace import Workspace
from ecm_extract.link.owning.composition import Composition
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.collect import Required, all_requirements
from ecm_extract.system.kept_texts import kept_texts
from ecm_extract.system.running import running_of


def hubs(workspace: Workspace, composition: Composition, of_sources: Callable[[], Required]) -> Mapping[str, Hub]:
    """Return what each package of a tree provides and requires, by name.

    Args:
        workspace: the linked tree.
        composition: what runs in which program of it.
        of_sources: gives what its sources require; asked last, for another process may be about it.
    """
    provisions: dict[str, list[Provision]] = defaultdict(list)
    for entity in public_entities(workspace).values():
        provisions[entity.package].append(entity)
    inner = InnerNames(workspace.packages)
    for facts in workspace.packages:
        provisions[facts.name] += inner.of(facts, launch_files(workspace.texts, facts))
    kept = _kept(workspace, composition)
    found = all_requirements(workspace, of_sources())
    return {
        facts.name: _hub(facts, provisions[facts.name], found.get(facts.name, ()), kept) for facts in workspace.packages
    }


class _Kept(msgspec.Struct, frozen=True):
    """What a later comparison asks of files.

    Attributes:
        blobs: their ids by path. notes: sentences of changelogs by path. shared: paths of what concerns all packages.
        around: what the tree tells of its packages beside their own files.
        running: what runs, by package. texts: contents that launch files need, by path.
    """

    blobs: Mapping[str, str]
    notes: Mapping[str, Sequence[str]]
    shared: tuple[str, ...]
    around: Surroundings
    running: Mapping[str, Running]
    texts: Mapping[str, str]


def _kept(workspace: Workspace, composition: Composition) -> _Kept:
    entries = listed(workspace.tree, workspace.packages)
    owned = {entry.path for facts in workspace.packages for entry in facts.root.files}
    shared = tuple(entry.path for entry in entries if entry.path not in owned)
    return _Kept(
        blobs={entry.path: entry.identity for entry in entries if entry.identity},
        notes=read_notes(workspace.tree, [entry.path for entry in entries]),
        shared=shared,
        around=surroundings(workspace.tree, workspace.packages),
        running=running_of(workspace.packages, workspace.linked, composition),
        texts=kept_texts(workspace.tree, workspace.texts, workspace.packages, shared),
    )


def _hub(facts: PackageFacts, entities: Sequence[Provision], required: Sequence[Requirement], kept: _Kept) -> Hub:
    paths = sorted({*(entry.path for entry in facts.root.files), *kept.shared})
    return Hub(
        manifest=facts.root.manifest,
        provides=tuple(provided(entity) for entity in entities),
        requires=tuple(required),
        bound=tuple(sorted(set(bound_names(facts)))),
        quoted=tuple(sorted(set(quoted_names(facts)))),
        interfaces={
            interface_name(facts.name, path, definition): json_data(definition)
            for path, definition in sorted(facts.interfaces.items())
        },
        files={path: kept.blobs.get(path, "") for path in paths},
        notes={path: tuple(kept.notes[path]) for path in paths if path in kept.notes},
        **told_of_build(facts, kept.around),
        running=_running(facts, kept),
    )


def _running(facts: PackageFacts, kept: _Kept) -> Running:
    paths = sorted({*(entry.path for entry in facts.root.files), *kept.shared} & kept.texts.keys())
    return msgspec.structs.replace(kept.running[facts.name], texts={path: kept.texts[path] for path in paths})
