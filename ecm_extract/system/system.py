"""One launch of a tree, as a whole: what it starts and how that is connected."""

from __future__ import annotations

import gc
from collections.abc import Sequence
from dataclasses import dataclass

from ecm_extract.description.model import Description
from ecm_extract.errors import InputError
from ecm_extract.extraction_model import Options
from ecm_extract.link.composition import composition_of
from ecm_extract.link.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.read.reader import Reader
from ecm_extract.settings import config_of
from ecm_extract.system.controllers import Controller, controllers_of
from ecm_extract.system.evaluate import launched
from ecm_extract.system.files import TREE, Files
from ecm_extract.system.frames import FrameEdge, frames_of
from ecm_extract.system.model import Given, Launched
from ecm_extract.system.modules import ModuleIndex
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.nodes import NodeMaker
from ecm_extract.system.robots import MAX_ROBOTS, controller_files, descriptions_of
from ecm_extract.system.simulation import simulated_nodes
from ecm_extract.tree import FileDiagnostic, Tree, printable


@dataclass(slots=True)
class System:
    """What launch files start, and how that is connected.

    Attributes:
        tree: where it was read. launched: what the launch files themselves say.
        nodes: with their endpoints. controllers: with their claims.
        robots: descriptions in use. frames: transforms that are published.
    """

    tree: Tree
    launched: Launched
    nodes: list[SystemNode]
    controllers: list[Controller]
    robots: list[Description]
    frames: list[FrameEdge]


_CUT = "launch-too-long"
"""A launch file that was not read to its end is one all the same."""
_LOOKED_FOR = "looked for: a root <launch>, a list `launch:` in YAML, a Python function generate_launch_description"


class LaunchError(InputError):
    """A launch file that was asked for is not in the tree, or is no launch file."""


def read_system(tree: Tree, launches: Sequence[str], given: Given, options: Options) -> System:
    """Read a tree and evaluate launch files over it.

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
    config = config_of(tree, options)
    enabled = gc.isenabled()
    gc.disable()  # see `extraction`: records without cycles
    try:
        include_tests = options.include_tests or config.extract.include_tests
        reader = Reader(tree, include_tests, config.extract.exclude, options.cache)
        packages = reader.read(options.jobs, options.progress)
        linker = Linker(packages, form_table(config.forms))
        linked = linker.link()
        linker.tell(tree)
        index = ModuleIndex(linked, packages, composition_of(linker.modules, linker.references))
        files = Files(tree, packages)
        paths = [_path(entry, files) for entry in launches]
        system = evaluated_system(tree, files, index, paths, given)
        _refuse_unread(system, paths)
        return system
    finally:
        if enabled:
            gc.enable()


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
    )


def _refuse_unread(system: System, paths: Sequence[str]) -> None:
    """Who names files that start nothing must not be told that nothing is wrong; one that was read shows itself."""
    if any(path in system.launched.files for path in paths):
        return
    for path in paths:
        why = next((entry for entry in system.tree.diagnostics if entry.path == printable(path)), None)
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
