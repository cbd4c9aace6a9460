"""Releases of the paper's grasping module, from its complete contracts, and what may be wrong with them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
from ecm_checker.contract import Contract, Value
from ecm_checker.encode import encode
from ecm_checker.fields import missing_fields
from ecm_checker.hub.package import Package
from ecm_checker.wire import Module

from ecm_extract.check_inputs import subject

FOLDER = Path(__file__).parents[2] / "fixtures" / "paper" / "scenario_upgrade"
MODULE = "ecm.delivery.grasp_instrument"


def contract(**fields: Any) -> Contract:
    """The old contract, complete, with `section__field` set to other values; None takes one away."""
    found = subject(str(FOLDER / "old.ecm.yaml")).contracts[0]
    every = {"behavior__invariants": ["held"], "versioning__compat_level": "full", "versioning__policy_change": False}
    every |= {"permissions__data": [], "permissions__network": False, "permissions__operational": []}
    every |= {"permissions__audit": "none"}
    for path, value in {**every, **fields}.items():
        section, name = path.split("__")
        changed = None if value is None else Value(value, "declared")
        part = msgspec.structs.replace(getattr(found, section), **{name: changed})
        found = msgspec.structs.replace(found, **{section: part})
    return msgspec.structs.replace(found, missing=missing_fields(found))


def package(version: str, *contracts: Contract, **rest: Any) -> Package:
    """A release of the package with these modules."""
    modules = []
    for each in contracts:
        identity = msgspec.structs.replace(each.ecm, version=version)
        modules.append(msgspec.convert(encode(msgspec.structs.replace(each, ecm=identity)), Module))
    rest = {"manifest": "delivery/package.xml", **rest}
    return Package(name="delivery", version=version, path="delivery", ros=2, modules=tuple(modules), **rest)
