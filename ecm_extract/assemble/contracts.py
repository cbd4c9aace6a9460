"""Contracts of the modules of a tree."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

import msgspec
from ecm_checker.contract import Contract, Identity, Source
from ecm_checker.fields import missing_fields
from ecm_parsers.source.facts import SourceFile

from ecm_extract.assemble.behavior import behavior_of
from ecm_extract.assemble.controller_settings import ControllerSettings
from ecm_extract.assemble.definitions import Definitions
from ecm_extract.assemble.distinct_names import distinct
from ecm_extract.assemble.permissions import permissions_of
from ecm_extract.assemble.recovery import recovery_of
from ecm_extract.assemble.resources import resources_of
from ecm_extract.assemble.signature import signature_of
from ecm_extract.assemble.versioning import versioning_of
from ecm_extract.extraction_model import PackageContracts
from ecm_extract.link.linker import LinkedModule
from ecm_extract.overlay.merge import overlaid
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.launch_files import is_launch_file
from ecm_extract.tree import Tree


def assemble(
    tree: Tree, packages: Sequence[PackageFacts], linked: Iterable[LinkedModule]
) -> tuple[PackageContracts, ...]:
    """Return the contracts of every package, sorted by path; modules by their id."""
    by_package: dict[str, list[LinkedModule]] = defaultdict(list)
    for entry in linked:
        by_package[entry.module.package].append(entry)
    definitions = Definitions(packages)
    settings = ControllerSettings(packages)
    return tuple(_package(tree, facts, by_package[facts.name], definitions, settings) for facts in packages)


def _package(
    tree: Tree,
    facts: PackageFacts,
    linked: list[LinkedModule],
    definitions: Definitions,
    settings: ControllerSettings,
) -> PackageContracts:
    version = facts.manifest.version if facts.manifest is not None else None
    contracts = [_contract(tree, facts, entry, definitions, settings) for entry in linked]
    if facts.interfaces or not contracts:
        contracts.append(_package_contract(tree, facts, definitions))
    if facts.overlay is not None:
        contracts = overlaid(tree, *facts.overlay, contracts)
    ros = facts.ros if facts.ros in {1, 2} else None
    modules = tuple(sorted(distinct(contracts), key=lambda contract: contract.ecm.module_id))
    return PackageContracts(facts.name, version, facts.root.path or ".", ros, modules)  # type: ignore[arg-type]


def _contract(
    tree: Tree, facts: PackageFacts, entry: LinkedModule, definitions: Definitions, settings: ControllerSettings
) -> Contract:
    module = entry.module
    identity = _identity(tree, facts, module.name, module.kind, module.path)
    contract = Contract(
        ecm=identity,
        signature=signature_of(entry, definitions),
        behavior=behavior_of(entry),
        resources=resources_of(entry, facts, settings),
        permissions=permissions_of(entry, facts),
        recovery=recovery_of(entry, facts, definitions),
        versioning=versioning_of(facts),
    )
    return msgspec.structs.replace(contract, missing=missing_fields(contract))


def _package_contract(tree: Tree, facts: PackageFacts, definitions: Definitions) -> Contract:
    """The contract of what a package offers as a whole: its interface files, its launch files, or a library."""
    kind = _package_kind(facts)
    path = facts.root.manifest or facts.root.path
    identity = _identity(tree, facts, "interfaces" if facts.interfaces else facts.name, kind, path)
    contract = Contract(ecm=identity, versioning=versioning_of(facts, definitions))
    return msgspec.structs.replace(contract, missing=missing_fields(contract))


def _package_kind(facts: PackageFacts) -> str:
    """A package whose launch files start the modules of others has no source of its own beside them."""
    if facts.interfaces:
        return "interface"
    has_code = any(_declares(source) for path, source in facts.sources.items() if not is_launch_file(path))
    launches = any(is_launch_file(entry.path) for entry in facts.root.files)
    return "launch" if launches and not has_code else "library"


def _declares(source: SourceFile) -> bool:
    """A setup.py and an empty `__init__.py` declare nothing that others could use."""
    return bool(source.classes) or any(function.name != "<module>" for function in source.functions)


def _identity(tree: Tree, facts: PackageFacts, name: str, kind: str, path: str) -> Identity:
    return Identity(
        module_id=f"ecm.{facts.name}.{name}",
        package=facts.name,
        kind=kind,
        version=facts.manifest.version if facts.manifest is not None else None,
        source=Source(tree.repository, tree.commit, path),
        ros=facts.ros if facts.ros in {1, 2} else None,  # type: ignore[arg-type]
    )
