"""What can be started of a tree: programs that the sourced ROS 2 has of its packages, and scripts of rclpy."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ecm_checker.contract import Contract
from ecm_checker.view import view
from path_a.ros2 import PYTHON, prefix_of

from ecm_extract.check_inputs import subject
from ecm_extract.observe.expected import is_node_of

_RUNS = frozenset({"node", "script", "component"})
_RUNS_NOT = frozenset({"interface", "library"})


@dataclass(frozen=True)
class Tree:
    """A source tree with its contracts of ROS 2 nodes, by package."""

    path: Path
    contracts: tuple[Contract, ...]


@dataclass(frozen=True)
class Candidate:
    """How something is started.

    Attributes:
        name: `package/program`. line: command. package: whose it is.
        source: path in the tree of a script; empty for a program.
    """

    name: str
    line: tuple[str, ...]
    package: str
    source: str = ""


def tree_of(path: Path) -> Tree:
    found = (each for each in subject(str(path)).contracts if each.ecm.ros == 2)
    return Tree(path, tuple(found))


def candidates(tree: Tree) -> Iterator[Candidate]:
    """Yield installed programs of the packages of a tree; of packages that are not installed, their scripts."""
    packages = sorted({each.ecm.package for each in tree.contracts if each.ecm.kind in _RUNS})
    for package in packages:
        prefix = prefix_of(package)
        programs = sorted((prefix / "lib" / package).glob("*")) if prefix is not None else []
        installed = [path for path in programs if path.is_file() and os.access(path, os.X_OK)]
        for path in installed:
            yield Candidate(f"{package}/{path.name}", (str(path),), package)
        if not installed:
            yield from _scripts(tree, package)


def _scripts(tree: Tree, package: str) -> Iterator[Candidate]:
    """Files that contracts were read from and that make a node by themselves."""
    places = {each.ecm.source.path for each in tree.contracts if each.ecm.package == package}
    for place in sorted(places):
        path = tree.path / place
        if path.is_file() and path.suffix not in {".cpp", ".cc", ".hpp", ".xml"} and _makes_a_node(path.read_bytes()):
            yield Candidate(f"{package}/{path.name}", (PYTHON, str(path)), package, place)


def python_path(tree: Tree) -> str:
    """Folders of the tree from which an installation would take Python packages."""
    roots = sorted({str(path.parent) for path in tree.path.rglob("setup.py") if (path.parent / "package.xml").exists()})
    return os.pathsep.join([*roots, os.environ.get("PYTHONPATH", "")])


def _makes_a_node(text: bytes) -> bool:
    return b"rclpy" in text and b"__main__" in text


def of_node(tree: Tree, candidate: Candidate, node: str) -> tuple[Contract, ...]:
    """Contracts of which a node of a program is an instance: of its script, by name, the script's only one."""
    running = [each for each in tree.contracts if each.ecm.package == candidate.package]
    running = [each for each in running if each.ecm.kind not in _RUNS_NOT]
    named = tuple(each for each in running if is_node_of(node, view(each)))
    written = tuple(each for each in running if each.ecm.source.path == candidate.source)
    own = tuple(each for each in written if each in named or _is_one_of_several(node, each))
    return own or named or (written if len(written) == 1 else ())


def _is_one_of_several(node: str, module: Contract) -> bool:
    """Whether a contract has the name of a node with its program's behind it, as where programs share the node's."""
    own = module.ecm.module_id.removeprefix(f"ecm.{module.ecm.package}.")
    return own.startswith(node.strip("/").replace("/", ".") + "_")
