"""Sources that are called like tests and are programs all the same, since the package installs or starts them."""

from __future__ import annotations

from collections.abc import Iterator
from posixpath import dirname, join, normpath

from ecm_parsers import package_xml
from ecm_parsers.cmake_facts import CmakeFile

from ecm_extract.cmake.sources import paths_of
from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.select import SourceKind, source_kind
from ecm_extract.test_code import is_in_test_folder


def installed_sources(package: PackageFacts) -> list[tuple[str, SourceKind]]:
    """Return (path, kind) of sources of programs that can be started; in a folder of tests they stay tests."""
    root = package.root.path
    wanted = {*_of_entry_points(package), *_of_targets(package)}
    files = (entry for entry in package.root.files if entry.path in wanted and not is_in_test_folder(entry.path, root))
    found = ((entry.path, source_kind(entry, root)) for entry in files)
    return [(path, kind) for path, kind in found if kind is not None]


def _of_entry_points(package: PackageFacts) -> Iterator[str]:
    """The modules of console scripts; setup.py may keep its packages in a folder such as `src`."""
    modules = {
        entry.module.replace(".", "/") + ".py"
        for setup in package.setups.values()
        for entry in setup.entry_points
        if entry.group == "console_scripts"
    }
    for entry in package.root.files:
        if any(entry.path == module or entry.path.endswith("/" + module) for module in modules):
            yield entry.path


def _of_targets(package: PackageFacts) -> Iterator[str]:
    for path, file in package.cmake.items():
        yield from _of_file(path, file, as_built=_starts_as_built(package))


def _starts_as_built(package: PackageFacts) -> bool:
    """Tell whether programs are started where they are built: in rosbuild, and in the devel space of catkin."""
    return package.root.rosbuild or (package.manifest is not None and package_xml.ros_version(package.manifest) == 1)


def _of_file(path: str, file: CmakeFile, *, as_built: bool) -> Iterator[str]:
    rules = [rule for rule in file.installs if rule.by_default is not False]
    installed = {item for rule in rules if rule.kind == "targets" for item in rule.items}
    for target in file.targets:
        built = as_built and target.by_default is not False
        if target.kind == "executable" and not target.is_test and (built or target.name in installed):
            yield from paths_of(target, path)
    for rule in rules:
        if rule.kind == "programs":
            yield from (normpath(join(dirname(path), item)) for item in rule.items)
