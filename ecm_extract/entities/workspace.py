"""A tree read and linked, and the side of a comparison that it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from ecm_parsers.interface_facts import Definition
from ecm_parsers.source.facts import SourceFile

from ecm_extract.collector import rare_collector, without_collector
from ecm_extract.entities.collect import public_entities
from ecm_extract.entities.interfaces import interface_name
from ecm_extract.entities.listed import listed
from ecm_extract.entities.notes import read_notes
from ecm_extract.entities.python import bound_names, quoted_names
from ecm_extract.entities.shared_reader import SharedReader
from ecm_extract.entities.side import PackageInfo, Side
from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.extraction_model import Options
from ecm_extract.link.declaring.forms import FormTable, form_table
from ecm_extract.link.index.program import Program
from ecm_extract.link.linker import LinkedModule, Linker
from ecm_extract.link.running.objects import Objects
from ecm_extract.macros.second_reading import read_with_header_macros
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.parameter_reads import parameter_read_requirements
from ecm_extract.settings import config_of
from ecm_extract.tree import Tree, unread_of


@dataclass(slots=True)
class Workspace:
    """A tree linked: what uses are read off, dropped as soon as they are."""

    tree: Tree
    packages: list[PackageFacts]
    linked: list[LinkedModule]
    program: Program
    objects: Objects
    _texts: SideTexts | None = None

    @property
    def texts(self) -> SideTexts:
        """What is read beside sources, read when it is first asked for."""
        if self._texts is None:
            self._texts = SideTexts(self.tree, self.packages)
        return self._texts


@dataclass(slots=True)
class PackagesRead:
    """A tree read and not yet linked, with the rows of forms that it adds."""

    tree: Tree
    packages: list[PackageFacts]
    forms: FormTable


def read_workspace(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> Workspace:
    """Read and link a tree; see `read_packages`."""
    return link_packages(read_packages(tree, options, parsed))


def read_packages(tree: Tree, options: Options, parsed: dict[str, SourceFile]) -> PackagesRead:
    """Read a tree.

    Args:
        tree: to read.
        options: of the extraction.
        parsed: facts by blob id; what is in it is not parsed again, what is parsed is added.
    """
    config = config_of(tree, options)
    with without_collector():
        include_tests = options.include_tests or config.extract.include_tests
        reader = SharedReader(tree, include_tests, config.extract.exclude, options.cache)
        reader.parsed = parsed
        packages = reader.read(options.jobs, options.progress)
        read_with_header_macros(packages, tree, config.headers)
        return PackagesRead(tree, packages, form_table(config.forms))


def link_packages(read: PackagesRead) -> Workspace:
    """Link what was read."""
    with rare_collector():
        linker = Linker(read.packages, read.forms)
        workspace = Workspace(read.tree, read.packages, linker.link(), linker.program, linker.folder.objects)
        linker.tell(read.tree)
        return workspace


def side_of(workspace: Workspace) -> Side:
    """Return the public entities of a linked tree."""
    tree, packages = workspace.tree, workspace.packages
    entries = listed(tree, packages)
    return Side(
        commit=tree.commit,
        packages={facts.name: _info(facts) for facts in packages},
        entities=public_entities(workspace),
        interfaces=_interfaces(packages),
        paths=frozenset(entry.path for entry in entries),
        blobs={entry.path: entry.identity for entry in entries if entry.identity},
        bound=frozenset(name for facts in packages for name in bound_names(facts)),
        quoted=frozenset(name for facts in packages for name in quoted_names(facts)),
        reads=frozenset((package, each.name) for package, each in parameter_read_requirements(workspace.program)),
        notes=partial(read_notes, tree),
        unread=tuple(unread_of(tree.diagnostics)),
    )


def _info(facts: PackageFacts) -> PackageInfo:
    version = facts.manifest.version if facts.manifest is not None else None
    return PackageInfo(facts.name, version, facts.root.path, facts.root.manifest, facts.ros)


def _interfaces(packages: list[PackageFacts]) -> dict[str, Definition]:
    return {
        interface_name(facts.name, path, definition): definition
        for facts in packages
        for path, definition in facts.interfaces.items()
    }
