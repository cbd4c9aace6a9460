"""Sides read from contracts: manifests that somebody kept, against manifests or sources of now.

A manifest holds what a module offers in the graph and the interfaces that its package defines, and nothing of its
symbols. Both sides are therefore compared by their contracts as soon as one of them has no more.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import msgspec
from ecm_checker.contract import Contract, Evidence
from ecm_checker.encode import decode
from ecm_parsers.yaml_tree import parse_yaml, plain

from ecm_extract.diff.sides import Sides
from ecm_extract.entities.endpoints import entity_of
from ecm_extract.entities.model import Key, PublicEntity
from ecm_extract.entities.side import PackageInfo, Side
from ecm_extract.errors import InputError
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Extraction, Options
from ecm_extract.report.manifest_yaml import SUFFIX
from ecm_extract.tree import Tree

_MANIFESTS: Final = frozenset({"package.xml", "manifest.xml"})


def holds_contracts(tree: Tree) -> bool:
    """Tell whether a tree has manifests of modules and no package that they could be read from."""
    paths = [entry.path for entry in tree.files()]
    return any(path.endswith(SUFFIX) for path in paths) and not any(
        path.rsplit("/", 1)[-1] in _MANIFESTS for path in paths
    )


def contract_sides(old: Tree, new: Tree, options: Options) -> Sides:
    """Read both sides down to what contracts hold; no uses can be read off them.

    Raises:
        InputError: a manifest is none.
    """
    return Sides(_side(old, options), _side(new, options), None)


def _side(tree: Tree, options: Options) -> Side:
    extraction = None if holds_contracts(tree) else extract(tree, options)
    contracts = list(_manifests(tree) if extraction is None else _extracted(extraction))
    if not contracts:
        message = f"{tree.label} holds no ROS package and no manifest"
        raise InputError(message, "name a folder of packages, or one that `ecm-extract` wrote manifests into")
    entities: dict[Key, PublicEntity] = {}
    for contract in contracts:
        for entity in _entities(contract):
            entities.setdefault(entity.key, entity)
    packages = {each.ecm.package: _package(each) for each in contracts}
    return Side(tree=tree, packages=packages, entities=entities, unread=extraction.unread if extraction else ())


def _manifests(tree: Tree) -> Iterator[Contract]:
    for path, data in tree.read_many(sorted(entry.path for entry in tree.files() if entry.path.endswith(SUFFIX))):
        for document in map(plain, parse_yaml(data).facts):
            try:
                yield decode(document)
            except msgspec.ValidationError as error:
                message = f"{path}: {error}"
                raise InputError(message, "a manifest is what `ecm-extract PATH` writes") from error


def _extracted(extraction: Extraction) -> Iterable[Contract]:
    return (module for package in extraction.packages for module in package.modules)


def _package(contract: Contract) -> PackageInfo:
    identity = contract.ecm
    return PackageInfo(identity.package, identity.version, identity.package, None, identity.ros)


def _entities(contract: Contract) -> Iterator[PublicEntity]:
    identity = contract.ecm
    owner = identity.module_id.rpartition(".")[2]
    for entry in contract.signature.interfaces:
        found = entity_of(entry, identity.package, owner, identity.ros)
        if found is not None:
            yield found
    for entity in contract.versioning.entities:
        at = next(iter(entity.evidence), Evidence("", 0))
        yield PublicEntity(
            kind=entity.kind,
            package=entity.package,
            owner=entity.owner,
            name=entity.name,
            type=entity.signature if entity.kind != "message" else None,
            default=entity.default,
            ros=identity.ros,
            path=at.path,
            line=at.line,
        )
