"""The hash by which evidence names the contract that it is about, whoever read it and from which clone."""

from __future__ import annotations

import hashlib

import msgspec
from ecm_checker.contract import Contract
from ecm_checker.encode import encode


def contract_digest(contract: Contract) -> str:
    """Return `sha256:` over the canonical JSON of a contract without the repository and commit it was read from."""
    source = msgspec.structs.replace(contract.ecm.source, repository=None, commit=None)
    plain = msgspec.structs.replace(contract, ecm=msgspec.structs.replace(contract.ecm, source=source))
    return f"sha256:{hashlib.sha256(msgspec.json.encode(encode(plain), order='sorted')).hexdigest()}"
