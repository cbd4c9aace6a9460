"""The packages of a workspace as documents would hold them, as far as rules of lint ask."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, cast

import msgspec
from ecm_checker.hub.package import Package, provided
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.launch.model import LaunchFile
from ecm_parsers.source.python import parse_python

from ecm_extract.entities.collect import graph_entities
from ecm_extract.entities.inner import InnerNames
from ecm_extract.entities.interfaces import interface_entities
from ecm_extract.entities.nodes import launched_nodes, node_entities
from ecm_extract.entities.packaging import program_entities
from ecm_extract.entities.told_of_build import Surroundings, surroundings, told_of_build
from ecm_extract.link.code.units import File
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.build_files import build_file_requirements
from ecm_extract.requires.collect import ordered
from ecm_extract.requires.dependencies import dependency_requirements
from ecm_extract.requires.diagnostics import diagnostic_requirements
from ecm_extract.requires.endpoints import endpoint_requirements
from ecm_extract.requires.interface_types import interface_requirements
from ecm_extract.requires.launch_files import requirements_of_file
from ecm_extract.requires.launch_values import loaded_value_requirements
from ecm_extract.requires.plugin_descriptions import plugin_description_requirements
from ecm_extract.requires.python_modules import module_requirements, reachable
from ecm_extract.requires.python_sources import import_requirements
from ecm_extract.requires.service_fields import service_field_requirements
from ecm_extract.requires.share_files import share_file_requirements

if TYPE_CHECKING:
    from ecm_extract.lint.workspace import Workspace


class _Together(msgspec.Struct, frozen=True):
    """What is told by the whole tree alone, by package."""

    around: Surroundings
    provided: Mapping[str, Sequence[Provision]]
    required: Mapping[str, Sequence[Requirement]]


def own_packages(workspace: Workspace) -> list[Package]:
    """Return the packages of a workspace with what rules of lint ask for, and the kinds of names that these mean."""
    around = surroundings(workspace.tree, workspace.packages)
    together = _Together(around, _provided(workspace), _of_program(workspace))
    return [_package(facts, workspace, together) for facts in workspace.packages]


def _provided(workspace: Workspace) -> Mapping[str, Sequence[Provision]]:
    """What sources offer that are understood together only."""
    found: dict[str, list[Provision]] = defaultdict(list)
    for entity in graph_entities(workspace.packages, workspace.linked).values():
        found[entity.package].append(entity)
    inner = InnerNames(workspace.packages)
    for facts in workspace.packages:
        found[facts.name] += inner.of(facts, _launches(facts, workspace))
    return found


def _of_program(workspace: Workspace) -> Mapping[str, Sequence[Requirement]]:
    """What sources require that are understood together only."""
    found: dict[str, list[Requirement]] = defaultdict(list)
    program = workspace.linker.program
    for package, each in service_field_requirements(program.files, workspace.linked, workspace.packages):
        found[package].append(each)
    for facts in workspace.packages:
        modules = [entry for entry in workspace.linked if entry.module.package == facts.name]
        found[facts.name] += (each for each in endpoint_requirements(modules) if each.row.linted)
    return found


def _package(facts: PackageFacts, workspace: Workspace, together: _Together) -> Package:
    entities = [*program_entities(facts), *interface_entities(facts), *_nodes(facts, workspace)]
    entities += together.provided.get(facts.name, ())
    return Package(
        name=facts.name,
        version=None,
        path=facts.root.path,
        ros=cast("Literal[1, 2] | None", facts.ros),
        manifest=facts.root.manifest,
        provides=tuple(provided(entity) for entity in entities),
        requires=ordered((*_required(facts, workspace), *together.required.get(facts.name, ()))),
        files={entry.path: "" for entry in facts.root.files},
        **told_of_build(facts, together.around),
    )


def _nodes(facts: PackageFacts, workspace: Workspace) -> Iterator[Provision]:
    """The nodes of a package, by the names of their programs and by those that its launch files give."""
    yield from node_entities(facts, [entry for entry in workspace.linked if entry.module.package == facts.name])
    for path, file in _launches(facts, workspace):
        yield from launched_nodes(facts, path, path.rpartition("/")[2], file.actions)


def _launches(facts: PackageFacts, workspace: Workspace) -> Iterator[tuple[str, LaunchFile]]:
    """The launch files of a package by path."""
    found = workspace.launches.items()
    return ((path, file) for path, file in found if workspace.package_of(path) == facts.name)


def _required(facts: PackageFacts, workspace: Workspace) -> Iterator[Requirement]:
    yield from dependency_requirements(facts)
    yield from interface_requirements(facts)
    yield from diagnostic_requirements(facts)
    yield from plugin_description_requirements(facts)
    yield from build_file_requirements(workspace.commands, facts)
    yield from share_file_requirements(workspace.tree.read_many, facts)
    yield from loaded_value_requirements(workspace.tree.read_many, facts)
    for path, file in _launches(facts, workspace):
        yield from requirements_of_file(facts, path, file, workspace.files.lines(path))
    packages = reachable(facts, workspace.packages)
    for source in _python_files(facts, workspace):
        yield from import_requirements(source)
        yield from module_requirements(source, packages)


def _python_files(facts: PackageFacts, workspace: Workspace) -> Iterator[File]:
    """The Python sources of a package, with its launch files, which belong to no program."""
    for path, source in facts.sources.items():
        if source.language == "python":
            yield File(path, facts.name, facts.ros, source)
    for path in workspace.launches:
        if path.endswith(".py") and path not in facts.sources and workspace.package_of(path) == facts.name:
            parsed = workspace.files.parsed(path, parse_python)
            if parsed is not None:
                yield File(path, facts.name, facts.ros, parsed.facts)
