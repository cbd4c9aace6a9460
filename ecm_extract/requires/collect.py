"""All requirements of the packages of a linked tree."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

import msgspec
from ecm_checker.hub.package import Package
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_parsers.source.python import parse_python

from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.entities.workspace import Workspace
from ecm_extract.link.code.units import File
from ecm_extract.link.index.program import Program, imported_names
from ecm_extract.link.linker import LinkedModule
from ecm_extract.link.running.objects import Objects
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.behavior_trees import behavior_tree_requirements
from ecm_extract.requires.build_files import build_file_requirements
from ecm_extract.requires.cpp_body import bodies
from ecm_extract.requires.cpp_headers import header_requirements
from ecm_extract.requires.cpp_members import member_requirements
from ecm_extract.requires.cpp_names import name_requirements
from ecm_extract.requires.cpp_overrides import override_requirements
from ecm_extract.requires.cpp_reached import reached_requirements
from ecm_extract.requires.cpp_results import result_requirements
from ecm_extract.requires.cpp_switches import switch_requirements
from ecm_extract.requires.dependencies import dependency_requirements
from ecm_extract.requires.descriptions import description_requirements
from ecm_extract.requires.diagnostics import diagnostic_requirements
from ecm_extract.requires.endpoints import endpoint_requirements
from ecm_extract.requires.ignored import comments_of, with_answers
from ecm_extract.requires.interface_types import interface_requirements
from ecm_extract.requires.kept import kept_for
from ecm_extract.requires.launch_files import launch_requirements
from ecm_extract.requires.launch_values import loaded_value_requirements
from ecm_extract.requires.parameter_files import parameter_file_requirements
from ecm_extract.requires.parameter_reads import parameter_read_requirements
from ecm_extract.requires.plugin_descriptions import plugin_description_requirements
from ecm_extract.requires.policies import policy_requirements
from ecm_extract.requires.python_fields import field_requirements
from ecm_extract.requires.python_modules import module_requirements, reachable
from ecm_extract.requires.python_sources import python_requirements
from ecm_extract.requires.rviz_files import rviz_requirements
from ecm_extract.requires.service_fields import service_field_requirements
from ecm_extract.requires.share_files import share_file_requirements
from ecm_extract.system.launch_files import is_launch_file

Required = Mapping[str, Sequence[Requirement]]
"""What is required, by package."""


def consumers(workspace: Workspace) -> list[Consumer]:
    """Return the packages of a linked tree as consumers."""
    ros = {facts.name: facts.ros for facts in workspace.packages}
    return [Consumer(package, entries, ros[package]) for package, entries in requirements(workspace).items()]


def requiring_packages(workspace: Workspace) -> tuple[Package, ...]:
    """Return the packages of a linked tree with what they require, and nothing of what they provide."""
    return tuple(
        Package(name=each.package, version=None, path="", ros=None, requires=tuple(each.requirements))
        for each in consumers(workspace)
    )


def requirements(workspace: Workspace) -> Required:
    """Return what each package of a linked tree requires, in the order of files and lines."""
    return all_requirements(workspace, source_requirements(workspace.program, workspace.objects))


def source_requirements(program: Program, objects: Objects) -> Required:
    """Return what sources require by what stands in them, by package; no module must be known for it."""
    found: dict[str, list[Requirement]] = defaultdict(list)
    for package, requirement in _of_program(program, objects):
        found[package].append(requirement)
    return found


def all_requirements(workspace: Workspace, of_sources: Required) -> Required:
    """Return what each package of a linked tree requires, in the order of files and lines.

    Args:
        workspace: the linked tree.
        of_sources: what its sources require.
    """
    modules: dict[str, list[LinkedModule]] = defaultdict(list)
    for module in workspace.linked:
        modules[module.module.package].append(module)
    found: dict[str, list[Requirement]] = {facts.name: [] for facts in workspace.packages}
    for facts in workspace.packages:
        found[facts.name] += _of_package(workspace, facts, modules[facts.name])
        found[facts.name] += of_sources.get(facts.name, ())
    for package, requirement in _of_modules(workspace):
        found[package].append(requirement)
    paths = {each.evidence[0].path for entries in found.values() for each in entries}
    present = frozenset(entry.path for entry in workspace.tree.files())
    kept = {path: distribution for path in paths if (distribution := kept_for(path, present))}
    comments = comments_of(workspace.tree, paths)
    return {
        package: ordered(each for entry in entries for each in with_answers(_kept(entry, kept), comments))
        for package, entries in found.items()
    }


def _kept(entry: Requirement, kept: Mapping[str, str]) -> Requirement:
    distribution = kept.get(entry.evidence[0].path)
    return msgspec.structs.replace(entry, kept_for=distribution) if distribution else entry


def _of_package(workspace: Workspace, facts: PackageFacts, modules: Sequence[LinkedModule]) -> Iterator[Requirement]:
    tree, texts = workspace.tree, workspace.texts
    yield from endpoint_requirements(modules)
    yield from parameter_file_requirements(tree, facts)
    yield from launch_requirements(texts, facts)
    yield from loaded_value_requirements(texts.read_many, facts)
    yield from description_requirements(texts, facts)
    yield from behavior_tree_requirements(facts)
    yield from policy_requirements(facts)
    yield from diagnostic_requirements(facts)
    yield from plugin_description_requirements(facts)
    yield from dependency_requirements(facts)
    yield from interface_requirements(facts)
    yield from rviz_requirements(tree, facts)
    yield from build_file_requirements(texts.commands, facts)
    yield from share_file_requirements(texts.read_many, facts)
    packages = reachable(facts, workspace.packages)
    for file in _python_launch_files(texts, facts):
        yield from python_requirements(file)
        yield from module_requirements(file, packages)


def _of_python(file: File) -> Iterator[Requirement]:
    yield from python_requirements(file)
    yield from field_requirements(file)


def _of_cpp(file: File, program: Program) -> Iterator[Requirement]:
    yield from header_requirements(file)
    yield from name_requirements(file, program)


def _of_modules(workspace: Workspace) -> Iterator[tuple[str, Requirement]]:
    """What sources require of modules of Python, and of services whose types their endpoints tell."""
    files = workspace.program.files
    known = {facts.name: reachable(facts, workspace.packages) for facts in workspace.packages}
    for file in files:
        if file.language == "python":
            yield from ((file.package, found) for found in module_requirements(file, known.get(file.package, ())))
    yield from service_field_requirements(files, workspace.linked, workspace.packages)


def _of_program(program: Program, objects: Objects) -> Iterator[tuple[str, Requirement]]:
    for file in program.files:
        for found in _of_python(file) if file.language == "python" else _of_cpp(file, program):
            yield file.package, found
    yield from parameter_read_requirements(program)
    yield from override_requirements(program)
    yield from result_requirements(program)
    yield from switch_requirements(program)
    for body in bodies(objects):
        for read in (member_requirements, reached_requirements):
            for found in read(body):
                yield body.func.file.package, found


def _python_launch_files(texts: SideTexts, facts: PackageFacts) -> Iterator[File]:
    """Launch files in Python, which belong to no program, as the sources that they are."""
    paths = sorted(
        entry.path
        for entry in facts.root.files
        if entry.path.endswith(".py") and entry.path not in facts.sources and is_launch_file(entry.path)
    )
    for path, data in texts.read_many(paths):
        file = File(path, facts.name, facts.ros, parse_python(data).facts)
        file.imported = imported_names(file)
        yield file


def ordered(entries: Iterable[Requirement]) -> tuple[Requirement, ...]:
    """Return requirements in the order of files and lines, each once."""
    return tuple(sorted(dict.fromkeys(entries), key=_order))


def _order(entry: Requirement) -> tuple[str, int, str, str, str, bytes]:
    at = entry.evidence[0]
    return at.path, at.line, entry.use, entry.name, entry.owner, msgspec.json.encode(entry)
