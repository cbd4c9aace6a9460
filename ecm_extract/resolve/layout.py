"""Where a build of the packages has their headers and their Python modules."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from posixpath import dirname

from ecm_extract.read.facts import PackageFacts
from ecm_extract.resolve.installed_python import installed_modules
from ecm_extract.resolve.message_constants import message_constants
from ecm_extract.resolve.paths import tree_path


@dataclass(frozen=True, slots=True)
class PackageLayout:
    """One package.

    Attributes:
        root: its folder, from the root of the tree.
        include_folders: in which headers are looked for: of its targets, and `include`, which ament and catkin export.
        modules: name of a Python package or module that it installs -> path in the tree, without `.py`.
        python_roots: folders that are on the Python path as they are.
        messages: messages, services and actions that it defines, as `msg/Name`.
        constants: constants of these, as `Name.CONSTANT` and `Name.Request.CONSTANT`.
    """

    root: str
    include_folders: tuple[str, ...] = ()
    modules: Mapping[str, str] = field(default_factory=dict)
    python_roots: tuple[str, ...] = ()
    messages: frozenset[str] = frozenset()
    constants: Mapping[str, str | float] = field(default_factory=dict)


def layouts(packages: Iterable[PackageFacts]) -> Mapping[str, PackageLayout]:
    """Return the layout of each package by its name; packages of one name count as one."""
    found: dict[str, list[PackageLayout]] = defaultdict(list)
    for package in sorted(packages, key=lambda each: each.root.path):
        found[package.name].append(_layout(package))
    return {name: _joined(listed) for name, listed in found.items()}


def _layout(package: PackageFacts) -> PackageLayout:
    root = package.root.path
    own = (tree_path(root, "src"), tree_path(root, "lib")) if package.root.rosbuild else ()
    folders = tuple(dict.fromkeys(_include_folders(package)))
    return PackageLayout(root, folders, installed_modules(package), own, _messages(package), message_constants(package))


def _messages(package: PackageFacts) -> frozenset[str]:
    paths = (PurePosixPath(path) for path in package.interfaces)
    return frozenset(f"{path.suffix[1:]}/{path.stem}" for path in paths)


def _include_folders(package: PackageFacts) -> Iterator[str]:
    for path, file in package.cmake.items():
        for target in file.targets:
            yield from (tree_path(dirname(path), each) for each in target.include_folders if "$" not in each)
    yield tree_path(package.root.path, "include")


def _joined(listed: list[PackageLayout]) -> PackageLayout:
    if len(listed) == 1:
        return listed[0]
    modules = {name: path for each in listed for name, path in each.modules.items()}
    folders = tuple(dict.fromkeys(folder for each in listed for folder in each.include_folders))
    roots = tuple(dict.fromkeys(folder for each in listed for folder in each.python_roots))
    messages = frozenset(name for each in listed for name in each.messages)
    constants = {name: value for each in listed for name, value in each.constants.items()}
    return PackageLayout(listed[0].root, folders, modules, roots, messages, constants)
