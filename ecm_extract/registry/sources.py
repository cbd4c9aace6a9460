"""From what a person names to packages that can be published: a folder, `DIR@REF`, or a document."""

from __future__ import annotations

from pathlib import Path

import msgspec
from ecm_checker.hub.package import Package

from ecm_extract.errors import InputError
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.registry.publish import Origin
from ecm_extract.report.json_document import package_document
from ecm_extract.stored import is_stored, read_stored
from ecm_extract.tree import Tree, open_tree
from ecm_extract.tree.git_ref import GitTree


class Source(msgspec.Struct, frozen=True):
    """Packages, and where they come from."""

    packages: tuple[Package, ...]
    origin: Origin


def read_source(spec: str, tag: str | None = None, jobs: int | None = None) -> Source:
    """Read packages.

    Args:
        spec: a source tree, `DIR@REF`, an extract document, that of a package, or a folder of these.
        tag: under which they were released, where the spec does not tell it.
        jobs: worker processes; None for one per core.

    Raises:
        InputError: nothing can be read there, or it holds no package.
    """
    found = _documents(spec, tag) if is_stored(spec) else _sources(spec, tag, jobs)
    if not found.packages:
        message = f"{spec} holds no ROS package"
        raise InputError(message, "name a folder with a package.xml below it, DIR@REF, or a document")
    return found


def packages_of(tree: Tree, jobs: int | None) -> tuple[Package, ...]:
    """Extract the packages of a tree as their documents hold them.

    Raises:
        TreeError: the tree cannot be listed.
        ConfigError: its `ecm.toml` is wrong.
    """
    extraction = extract(tree, Options(jobs=jobs, hub=True))
    documents = (package_document(extraction, each) for each in extraction.packages)
    found = (msgspec.json.decode(each, type=Package) for each in documents)
    return tuple(each for each in found if each.manifest is not None)  # files without a package.xml are no release


def _sources(spec: str, tag: str | None, jobs: int | None) -> Source:
    tree = open_tree(spec)
    packages = packages_of(tree, jobs)
    name = tree.repository or Path(spec).resolve().name
    if not isinstance(tree, GitTree):  # the files of a folder may differ from the commit around it
        return Source(packages, Origin(name, tag))
    named = spec.rpartition("@")[2] if "@" in spec else None
    return Source(packages, Origin(name, tag or named, tree.commit))


def _documents(spec: str, tag: str | None) -> Source:
    stored = read_stored(spec)
    known = (_repository(each) for each in stored.packages)
    name = next(filter(None, known), None) or Path(spec).resolve().name
    return Source(stored.packages, Origin(name, tag, stored.commit))


def _repository(package: Package) -> str | None:
    return next((each.ecm.source.repository for each in package.modules if each.ecm.source.repository), None)
