"""Descriptions of plugins: the classes that they promise to a loader, which sources must export."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath

from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.class_names import joined
from ecm_parsers.cmake_facts import Target
from ecm_parsers.plugin_xml import PluginClass

from ecm_extract.cmake.sources import paths_of
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required
from ecm_extract.test_code import is_test_path


def plugin_description_requirements(facts: PackageFacts) -> Iterator[Requirement]:
    """Yield the classes of C++ that the plugin descriptions of a package name; a class of Python needs no export."""
    unread = _half_read(facts)
    for path, classes in facts.plugins.items():
        for entry in classes if not is_test_path(path, facts.root.path) else ():
            if entry.type and not _is_python(entry):
                yield required(
                    "describes_class",
                    joined(entry.type),
                    Place(path, entry.line, f"file {path}"),
                    "unknown" if library_of(entry) in unread else "proved",
                    package=facts.name,
                    type=joined(entry.base_class_type) or None,
                    target=library_of(entry),
                    said=entry.lookup_name,
                )


def library_of(entry: PluginClass) -> str:
    """Return the library of a class as a target is called."""
    return PurePosixPath(entry.library).name.removesuffix(".so").removeprefix("lib")


def _is_python(entry: PluginClass) -> bool:
    return "::" not in entry.type and "." in entry.type


def _half_read(facts: PackageFacts) -> frozenset[str]:
    """Libraries of which a source is in the tree and was not read, as those of tests are."""
    files = {entry.path for entry in facts.root.files} - facts.sources.keys()
    targets = [(path, target) for path, file in facts.cmake.items() for target in file.targets]
    found = (target for path, target in targets if target.is_test or not files.isdisjoint(paths_of(target, path)))
    return frozenset(name.removeprefix("lib") for target in found for name in _names(target))


def _names(target: Target) -> Iterator[str]:
    yield from (name for name in (target.name, target.output) if name)
