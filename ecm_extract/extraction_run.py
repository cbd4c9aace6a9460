"""Extraction by reading: packages, facts, links, contracts."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import msgspec
from ecm_checker.hub.package import Hub, encode_hub

from ecm_extract.assemble.contracts import assemble
from ecm_extract.assemble.hub import hubs
from ecm_extract.collector import rare_collector, without_collector
from ecm_extract.config import Config
from ecm_extract.entities.workspace import Workspace
from ecm_extract.extraction_model import (
    Counts,
    Extraction,
    LocatedDiagnostic,
    Options,
    PackageContracts,
    sorted_diagnostics,
)
from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.link.owning.composition import composition_of
from ecm_extract.macros.second_reading import read_with_header_macros
from ecm_extract.macros.undecided import report_undecided
from ecm_extract.parallel_work import jobs_for, meanwhile
from ecm_extract.read.facts import function_count
from ecm_extract.read.reader import Reader
from ecm_extract.requires.collect import source_requirements
from ecm_extract.settings import config_of
from ecm_extract.tree import Tree, unread_of


def read_contracts(tree: Tree, options: Options) -> tuple[Extraction, dict[str, str]]:
    """Read the contracts of every package of a tree.

    Returns:
        The extraction, and the git blob id of each source file, of the bytes that its facts were read from.

    Raises:
        TreeError: the tree cannot be listed.
        ConfigError: `ecm.toml` is wrong.
    """
    config: Config = config_of(tree, options)
    with without_collector():
        include_tests = options.include_tests or config.extract.include_tests
        reader = Reader(tree, include_tests, config.extract.exclude, options.cache)
        packages = reader.read(options.jobs, options.progress)
        read_with_header_macros(packages, tree, config.headers)
        forms = form_table(config.forms)
        with rare_collector():
            linker = Linker(packages, forms)
            linker.declare()
            work = partial(source_requirements, linker.program, linker.folder.objects)
            jobs = jobs_for(function_count(packages), options.jobs)
            of_sources = meanwhile(work, jobs) if options.hub else work
            linked = linker.attributed()
        linker.tell(tree)
        report_undecided(packages, tree, forms.keys() | linker.helpers)
        contracts = assemble(tree, packages, linked)
        if options.hub:
            workspace = Workspace(tree, packages, linked, linker.program, linker.folder.objects)
            composition = composition_of(linker.modules, linker.references)
            contracts = _with_hubs(contracts, hubs(workspace, composition, of_sources))
    extraction = Extraction(
        path=tree.label,
        commit=tree.commit,
        packages=contracts,
        diagnostics=_diagnostics(tree),
        counts=Counts(reader.files, reader.bytes),
        unread=unread_of(tree.diagnostics),
    )
    return extraction, reader.blobs


def _with_hubs(contracts: tuple[PackageContracts, ...], found: Mapping[str, Hub]) -> tuple[PackageContracts, ...]:
    return tuple(msgspec.structs.replace(each, hub=encode_hub(found[each.name])) for each in contracts)


def _diagnostics(tree: Tree) -> tuple[LocatedDiagnostic, ...]:
    return sorted_diagnostics(
        LocatedDiagnostic(each.severity, each.code, each.path, each.line, each.message) for each in tree.diagnostics
    )
