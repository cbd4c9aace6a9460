"""A contract as plain data (what JSON and YAML hold) and back.

What is written when a value is not known:

- Identity (`ecm`) and interface keys are always there, null when not known. `default` is there for parameters
  only, `inherited_from`, `when` and `needed` only when set.
- A policy of `qos` that is not known is absent.
- A field of a section that nothing declares is absent; the required ones among them are named in
  `ecm.missing`. An empty list is something else: an artefact shows that there is none.

Keys come in the order of the model, keys of free-form values sorted, so equal contracts give equal bytes.
What JSON cannot hold (NaN, infinities, huge integers, lone surrogates) is written as text.
"""

from __future__ import annotations

from typing import Any, Final, TypeAlias

import msgspec

from ecm_checker.contract import Contract, Identity
from ecm_checker.hub.roles import roles
from ecm_checker.json_data import record_data
from ecm_checker.wire import MANIFEST_SCHEMA, Ecm, Module

Plain: TypeAlias = dict[str, Any]

_WHERE_SET: Final = frozenset({"when", "needed"})
_SECTIONS = ("signature", "behavior", "resources", "permissions", "recovery", "versioning")


def encode(contract: Contract) -> Plain:
    """Plain data of a contract, as it stands among `modules` of an extract document."""
    sections = {name: _section(getattr(contract, name)) for name in _SECTIONS}
    signature = sections["signature"]
    signature["interfaces"] = [_without_unset(each) for each in signature["interfaces"]]
    return {"ecm": record_data(_ecm(contract)), **sections}


def encode_manifest(contract: Contract) -> Plain:
    """Plain data of a contract in a file of its own: the schema number first."""
    return {"schema": MANIFEST_SCHEMA, **encode(contract)}


def decode(plain: Plain) -> Contract:
    """Read back what `encode` or `encode_manifest` gave.

    Args:
        plain: the data of a manifest; keys that this version does not know are passed over.

    Returns:
        The contract; lists inside free-form values stay lists.

    Raises:
        msgspec.ValidationError: a key is missing or has a wrong type; the message names its path.
    """
    module = msgspec.convert(plain, Module)
    identity = {name: getattr(module.ecm, name) for name in Identity.__struct_fields__}
    sections = {name: getattr(module, name) for name in _SECTIONS}
    return Contract(ecm=Identity(**identity), missing=module.ecm.missing, **sections)


def _ecm(contract: Contract) -> Ecm:
    identity = {name: getattr(contract.ecm, name) for name in Identity.__struct_fields__}
    return Ecm(**identity, missing=contract.missing)


def _section(section: msgspec.Struct) -> Plain:
    return {key: value for key, value in record_data(section).items() if value is not None}


def _without_unset(interface: Plain) -> Plain:
    absent = {"inherited_from"} if roles()[interface["role"]].value else {"inherited_from", "default"}
    told = {key: value for key, value in interface.items() if value is not None or key not in absent}
    return {key: value for key, value in told.items() if value or key not in _WHERE_SET}
