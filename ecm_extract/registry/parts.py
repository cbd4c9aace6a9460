"""What the files of a package provide and require, each file as a part that releases share."""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Iterator
from typing import Any, Final

import msgspec
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.package import Package, Provided
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.names import NAMES
from ecm_checker.match.provisions import last_part

from ecm_extract.registry.contents import compress, decompress

_LONGEST: Final = 500


class FilePart(msgspec.Struct, frozen=True):
    """What one file provides and requires."""

    provides: tuple[Provided, ...]
    requires: tuple[Requirement, ...]


class PackedPart(msgspec.Struct, frozen=True):
    """A part as it is stored: rows to ask, and `data`, from which its requirements come back."""

    digest: str
    data: bytes
    provisions: list[dict[str, Any]]
    requirements: list[dict[str, Any]]
    keys: list[dict[str, Any]]


def parts_of(package: Package) -> Iterator[FilePart]:
    """Yield the parts of a package, one for each file that has lines in it."""
    provides: dict[str, list[Provided]] = defaultdict(list)
    requires: dict[str, list[Requirement]] = defaultdict(list)
    for row in package.provides:
        provides[row.evidence[0].path].append(row)
    for entry in package.requires:
        requires[entry.evidence[0].path].append(entry)
    for path in sorted(provides.keys() | requires.keys()):
        yield FilePart(tuple(provides.get(path, ())), tuple(requires.get(path, ())))


def pack_part(part: FilePart) -> PackedPart:
    """Return a part as it is stored."""
    whole = msgspec.json.encode(part, order="deterministic")
    return PackedPart(
        digest=hashlib.sha256(whole).hexdigest(),
        data=compress(msgspec.msgpack.encode(part.requires)),
        provisions=[_provision(number, row) for number, row in enumerate(part.provides)],
        requirements=[_requirement(number, entry) for number, entry in enumerate(part.requires)],
        keys=[key for number, entry in enumerate(part.requires) for key in _keys(number, entry)],
    )


def requirements_of(data: bytes) -> tuple[Requirement, ...]:
    """Return the requirements of a part, in their order."""
    return msgspec.msgpack.decode(decompress(data, "a part"), type=tuple[Requirement, ...])


def _provision(number: int, row: Provided) -> dict[str, Any]:
    return {
        "number": number,
        "kind": row.kind,
        "owner": clipped(row.owner),
        "name": clipped(row.name),
        "last": clipped(last_part(row.name)),
        "type": row.type and clipped(row.type),
        "line": row.evidence[0].line,
    }


def _requirement(number: int, entry: Requirement) -> dict[str, Any]:
    return {
        "number": number,
        "use": entry.use,
        "kind": entry.kind,
        "package": entry.package and clipped(entry.package),
        "owner": clipped(entry.owner),
        "name": clipped(entry.name),
        "line": entry.evidence[0].line,
        "certainty": entry.certainty,
    }


def _keys(number: int, entry: Requirement) -> Iterator[dict[str, Any]]:
    found = NAMES[uses()[entry.use].names].keys(entry)
    for key in dict.fromkeys(map(clipped, found)):
        yield {"number": number, "use": entry.use, "key": key}


def clipped(text: str) -> str:
    """Return text as a database can hold and index it: what is looked for is clipped alike, and then matched whole."""
    return text.replace("\0", "\ufffd")[:_LONGEST]


def is_clipped(text: str) -> bool:
    """Whether text of a row may have been longer."""
    return len(text) >= _LONGEST
