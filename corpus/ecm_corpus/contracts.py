"""Contracts as data: the packages of a side, each in a file that is named by what it holds.

The commit that a contract was read at is in the results, not in the file, so that a package that did not change
between two refs is kept once.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

import msgspec
from ecm_checker.contract import Contract
from ecm_checker.encode import Plain, decode, encode

from ecm_extract.errors import InputError


def packed(contracts: Iterable[Contract]) -> bytes:
    """The contracts of one package as a JSON array, one contract a line."""
    lines = [msgspec.json.encode(encode(_without_commit(contract)), order="sorted") for contract in contracts]
    return b"[\n" + b",\n".join(lines) + b"\n]\n"


def unpacked(data: bytes) -> tuple[Contract, ...]:
    """Contracts from what `packed` wrote.

    Raises:
        msgspec.ValidationError: it is something else.
    """
    return tuple(decode(entry) for entry in msgspec.json.decode(data, type=list[Plain]))


def digest(data: bytes) -> str:
    """SHA-256 in hexadecimal, the name of a file in the store."""
    return hashlib.sha256(data).hexdigest()


def stored(name: str, folder: Path) -> bytes:
    """The content of one file of the store.

    Raises:
        InputError: it is not there, or holds something else than its name says.
    """
    path = folder / f"{name}.json"
    try:
        data = path.read_bytes()
    except OSError as error:
        message = f"cannot read {path}: {error.strerror}"
        raise InputError(message, "make corpus CLONES=DIR writes it") from error
    if digest(data) != name:
        message = f"{path} was changed: its content is not what its name says"
        raise InputError(message, "make corpus CLONES=DIR writes it anew")
    return data


def _without_commit(contract: Contract) -> Contract:
    source = contract.ecm.source
    if source is None or source.commit is None:
        return contract
    identity = msgspec.structs.replace(contract.ecm, source=msgspec.structs.replace(source, commit=None))
    return msgspec.structs.replace(contract, ecm=identity)
