"""One launch of a tree, as a whole: what it starts and how that is connected."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import msgspec
import networkx as nx
from ecm_checker.hub.package import Package
from ecm_checker.wire import NotRead

from ecm_extract.collector import without_collector
from ecm_extract.description.model import Description
from ecm_extract.errors import InputError
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import LocatedDiagnostic, Options
from ecm_extract.package_paths import owner_of
from ecm_extract.stored import Stored, packages_of
from ecm_extract.system.controllers import Controller, controllers_of
from ecm_extract.system.evaluate import launched
from ecm_extract.system.files import TREE, Files
from ecm_extract.system.frames import FrameEdge, frames_of
from ecm_extract.system.model import Given, Launched
from ecm_extract.system.modules import ModuleIndex
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.nodes import NodeMaker
from ecm_extract.system.package_folders import folders_stored
from ecm_extract.system.robots import MAX_ROBOTS, controller_files, descriptions_of
from ecm_extract.system.simulation import simulated_nodes
from ecm_extract.tree import FileDiagnostic, Tree, printable
from ecm_extract.tree.stored import NOT_KEPT, StoredTree
from ecm_extract.tree.unread import not_read


@dataclass(slots=True)
class System:
    """What launch files start, and how that is connected.

    Attributes:
        tree: where it was read. launched: what the launch files themselves say.
        nodes: with their endpoints. controllers: with their claims.
        robots: descriptions in use. frames: transforms that are published.
        unknown: what runs beside nodes, or in them, and may have endpoints that nothing tells.
        diagnostics: of the packages, then of the launch, each once.
        unread: what was not read of the packages that run, and of what they need of others.
    """

    tree: Tree
    launched: Launched
    nodes: list[SystemNode]
    controllers: list[Controller]
    robots: list[Description]
    frames: list[FrameEdge]
    unknown: frozenset[str] = frozenset()
    diagnostics: tuple[LocatedDiagnostic, ...] = ()
    unread: tuple[NotRead, ...] = ()


_CUT: Final = "launch-too-long"
"""A launch file that was not read to its end is one all the same."""
_LOOKED_FOR: Final = (
    "looked for: a root <launch>, a list `launch:` in YAML, a Python function generate_launch_description"
)


class LaunchError(InputError):
    """A launch file that was asked for is not in the tree, or is no launch file."""


class _Known(msgspec.Struct, frozen=True):
    """What is known of packages before a launch file is looked at, and what was not read of their tree."""

    packages: tuple[Package, ...]
    diagnostics: tuple[LocatedDiagnostic, ...]
    unread: tuple[NotRead, ...]


def read_system(tree: Tree, launches: Sequence[str], given: Given, options: Options) -> System:
    """Extract a tree and evaluate launch files over it.

    Args:
        tree: of a workspace or a repository.
        launches: paths in the tree, or `package/file`, as `roslaunch` and `ros2 launch` find it.
        given: arguments and environment of the launch.
        options: of the extraction.

    Raises:
        TreeError: the tree cannot be listed.
        ConfigError: `ecm.toml` is wrong.
        LaunchError: a launch file is not in the tree, or is none.
    """
    extraction = extract(tree, msgspec.structs.replace(options, hub=True))
    known = _Known(packages_of(extraction), extraction.diagnostics, not_read(extraction.unread))
    return _system(tree, known, launches, given)


def stored_system(stored: Stored, launches: Sequence[str], given: Given) -> System:
    """Evaluate launch files that lie in stored packages; see `read_system`.

    Raises:
        LaunchError: a launch file is in no stored package, or is none.
        InputError: the documents do not tell what runs.
    """
    _refuse_untold(stored)
    return _system(
        _tree_of(stored), _Known(stored.packages, stored.diagnostics, not_read(stored.unread)), launches, given
    )


def _refuse_untold(stored: Stored) -> None:
    for package in stored.packages:
        if not package.running:
            message = f"the document of {package.name} in {stored.label} does not tell what runs"
            raise InputError(message, "an older version wrote it; extract the package once more")


def _tree_of(stored: Stored) -> StoredTree:
    texts = {path: text for each in stored.packages if each.running for path, text in each.running.texts.items()}
    origins = (module.ecm.source.repository for each in stored.packages for module in each.modules)
    return StoredTree(stored.source, stored.commit, next(origins, None), frozenset(stored.files), texts)


def _system(tree: Tree, known: _Known, launches: Sequence[str], given: Given) -> System:
    with without_collector():
        before = frozenset(tree.diagnostics)
        index = ModuleIndex({package.name: package.running for package in known.packages if package.running})
        files = Files(tree, folders_stored(known.packages))
        paths = [_path(entry, files) for entry in launches]
        system = evaluated_system(tree, files, index, paths, given)
        told = [_located(entry) for entry in tree.diagnostics if entry not in before]
        diagnostics = tuple(dict.fromkeys((*known.diagnostics, *told)))
        system = replace(system, diagnostics=diagnostics, unread=tuple(_unread(system, known)))
        system.launched.is_complete &= not any(entry.code == NOT_KEPT for entry in told)
        _refuse_unread(system, paths)
        return system


def _unread(system: System, known: _Known) -> Iterator[NotRead]:
    """What was not read of packages whose nodes run, of those that they need, and outside of packages, each once."""
    by_name = {each.name: each for each in known.packages}
    wanted = ((each.name, asked.package) for each in known.packages for asked in each.requires if asked.package)
    needs = nx.DiGraph(wanted)
    running = {node.instance.package for node in system.nodes} & by_name.keys()
    needed = {name for each in running & needs.nodes for name in nx.descendants(needs, each)}
    gaps = [gap for name in sorted(running | needed & by_name.keys()) for gap in by_name[name].gaps]
    paths = {each.path for each in known.packages}
    outside = (each for each in known.unread if each.is_gap and owner_of(each.path, paths) is None)
    return iter(dict.fromkeys((*gaps, *outside)))


def _located(entry: FileDiagnostic) -> LocatedDiagnostic:
    return LocatedDiagnostic(entry.severity, entry.code, entry.path, entry.line, entry.message)


def evaluated_system(tree: Tree, files: Files, index: ModuleIndex, paths: Sequence[str], given: Given) -> System:
    """Return what launch files start together.

    Args:
        tree: gets the diagnostics.
        files: of the tree.
        index: of its modules.
        paths: of the launch files in the tree.
        given: arguments and environment of the launch.
    """
    found = launched(tree, files, paths, given)
    maker = NodeMaker(index, found, files)
    nodes = maker.nodes()
    described = descriptions_of(found, files)
    for path in described.left_out:
        message = f"More than {MAX_ROBOTS} robot descriptions are used; this one is left out. Launch the parts alone."
        tree.report(FileDiagnostic("error", "description-left-out", path, 0, message))
        found.is_complete = False
    robots = described.found
    for robot in robots:
        for each in robot.problems:
            tree.report(FileDiagnostic("info", "description-unread", each.path, each.line, f"{each.message}."))
    controllers = controllers_of(found, files, index, controller_files(robots))
    nodes += maker.hosted(controllers, robots)
    nodes += simulated_nodes(found.instances, robots)
    return System(
        tree=tree,
        launched=found,
        nodes=nodes,
        controllers=controllers,
        robots=robots,
        frames=frames_of(nodes, robots),
        unknown=frozenset(maker.unknown),
    )


def _refuse_unread(system: System, paths: Sequence[str]) -> None:
    """Who names files that start nothing must not be told that nothing is wrong; one that was read shows itself."""
    if any(path in system.launched.files for path in paths):
        return
    for path in paths:
        why = next((entry for entry in system.diagnostics if entry.path == printable(path)), None)
        if why is None or why.code != _CUT:
            message = f"{printable(path)} cannot be read as a launch file"
            raise LaunchError(message, why.message if why is not None else _LOOKED_FOR)


def _path(text: str, files: Files) -> str:
    """Return the path of a launch file that a person names."""
    path = files.find(f"{TREE}{text}")
    if path is None and text.count("/") == 1:
        path = files.in_package(*text.split("/"))
    if path is None:
        message = f"no launch file {text} in the tree"
        raise LaunchError(message, "name it by its path in the tree, or as package/file")
    return path
