"""Provides and requires of each package of a linked tree."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence

import msgspec
from ecm_checker.hub.package import Hub, provided
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.json_data import json_data

from ecm_extract.entities.collect import public_entities
from ecm_extract.entities.interfaces import interface_name
from ecm_extract.entities.notes import read_notes
from ecm_extract.entities.python import bound_names, quoted_names
from ecm_extract.entities.side import Workspace
from ecm_extract.parallel_work import meanwhile
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.collect import requirements


def hubs(workspace: Workspace, jobs: int | None) -> Mapping[str, Hub]:
    """Return what each package of a tree provides and requires, by name.

    Args:
        workspace: the linked tree.
        jobs: with one nothing is forked; else requirements are read off in another process.
    """
    required: Callable[[], Mapping[str, Sequence[Requirement]]] = meanwhile(lambda: requirements(workspace), jobs)
    provisions: dict[str, list[Provision]] = defaultdict(list)
    for entity in public_entities(workspace.tree, workspace.packages, workspace.linked).values():
        provisions[entity.package].append(entity)
    blobs = {entry.path: entry.identity for entry in workspace.tree.files() if entry.identity}
    notes = read_notes(workspace.tree, [entry.path for entry in workspace.tree.files()])
    found = required()
    return {
        facts.name: _hub(facts, provisions[facts.name], found.get(facts.name, ()), _Kept(blobs, notes))
        for facts in workspace.packages
    }


class _Kept(msgspec.Struct, frozen=True):
    """What a later comparison asks of files: their blob ids, and sentences of changelogs; by path."""

    blobs: Mapping[str, str]
    notes: Mapping[str, Sequence[str]]


def _hub(facts: PackageFacts, entities: Sequence[Provision], required: Sequence[Requirement], kept: _Kept) -> Hub:
    paths = sorted(entry.path for entry in facts.root.files)
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
    )
