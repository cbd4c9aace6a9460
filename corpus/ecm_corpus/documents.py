"""Documents of packages as data: the packages of a side, each in a file that is named by what it holds.

Only what the pinned checker reads is kept: contracts, provisions, requirements and names of files. The
commit that a package was read at is in the results, not in the file, so that a package that did not change between two
refs is kept once.
"""

from __future__ import annotations

import hashlib
import lzma
from collections.abc import Iterable
from pathlib import Path
from typing import Final

import msgspec
from ecm_checker.contract import Contract
from ecm_checker.encode import encode
from ecm_checker.hub.package import Package
from ecm_checker.json_data import json_data
from ecm_checker.wire import Module
from msgspec import UNSET

from ecm_extract.errors import InputError
from ecm_extract.extraction_model import PackageContracts
from ecm_extract.stored import package_of

STORE: Final = "documents"
"""Folder of the store below that of the corpus."""
SUFFIX: Final = ".json.xz"
"""How names in the store end; what comes before is the hash of what the file holds when it is unpacked."""


def document(extracted: PackageContracts) -> Package:
    """What the checker may ask of a package that was extracted just now."""
    whole = package_of(extracted)
    files = dict.fromkeys(whole.files, "")
    modules = _modules(extracted.modules)
    return msgspec.structs.replace(whole, modules=modules, interfaces={}, files=files, notes={}, running=UNSET)


def instances(started: Package, contracts: Iterable[Contract]) -> Package:
    """What launch files start together, with the contracts of its nodes."""
    return msgspec.structs.replace(started, modules=_modules(contracts))


def packed(packages: Iterable[Package]) -> bytes:
    """Packages of one name as a JSON array, one package a line."""
    return b"[\n" + b",\n".join(map(_line, packages)) + b"\n]\n"


def unpacked(data: bytes) -> tuple[Package, ...]:
    """Packages from what `packed` wrote.

    Raises:
        msgspec.ValidationError: it is something else.
    """
    return msgspec.json.decode(data, type=tuple[Package, ...])


def digest(data: bytes) -> str:
    """SHA-256 in hexadecimal, the name of a file in the store."""
    return hashlib.sha256(data).hexdigest()


def keep(name: str, data: bytes, folder: Path) -> None:
    """Write one file of the store; a file that is there already is what its name says."""
    path = folder / f"{name}{SUFFIX}"
    if not path.is_file():
        path.write_bytes(lzma.compress(data, preset=9))


def kept(folder: Path) -> dict[str, Path]:
    """The files of the store by name."""
    return {path.name.removesuffix(SUFFIX): path for path in folder.iterdir()}


def stored(name: str, folder: Path) -> bytes:
    """The content of one file of the store.

    Raises:
        InputError: it is not there, or holds something else than its name says.
    """
    path = folder / f"{name}{SUFFIX}"
    try:
        data = lzma.decompress(path.read_bytes())
    except OSError as error:
        message = f"cannot read {path}: {error.strerror}"
        raise InputError(message, "make corpus CLONES=DIR writes it") from error
    except lzma.LZMAError:
        data = b""
    if digest(data) != name:
        message = f"{path} was changed: its content is not what its name says"
        raise InputError(message, "make corpus CLONES=DIR writes it anew")
    return data


def _line(package: Package) -> bytes:
    try:
        return msgspec.json.encode(package, order="deterministic")
    except UnicodeEncodeError:  # somebody's file names and texts may be no Unicode
        return msgspec.json.encode(json_data(package), order="deterministic")


def _modules(contracts: Iterable[Contract]) -> tuple[Module, ...]:
    plain = [encode(_without_commit(contract)) for contract in contracts]
    return msgspec.convert(plain, tuple[Module, ...])


def _without_commit(contract: Contract) -> Contract:
    source = contract.ecm.source
    if source is None or source.commit is None:
        return contract
    identity = msgspec.structs.replace(contract.ecm, source=msgspec.structs.replace(source, commit=None))
    return msgspec.structs.replace(contract, ecm=identity)
