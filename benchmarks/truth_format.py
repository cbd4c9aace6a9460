"""The documented interface of a node, as written in truth/*.yaml, and how names and types are compared."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import msgspec

_TYPES = {
    "int": {"int", "integer", "int32", "int64", "uint8", "uint8_t", "int64_t", "uint16"},
    "double": {"double", "float", "float32", "float64"},
    "bool": {"bool", "boolean"},
    "string": {"string", "str", "std::string"},
    "string_array": {"string_array", "string[]", "std::vector<std::string>", "list"},
    "int_array": {"int_array", "integer_array", "int64_t_array", "std::vector<int64_t>"},
    "map": {"map", "dict", "dictionary"},
}
_CANONICAL = {spelling: name for name, spellings in _TYPES.items() for spelling in spellings}


class Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One interface that the document (or, for `undocumented`, the code alone) names."""

    role: str
    name: str
    type: str | None = None
    where: str | None = None


class Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Where rows were read: the name of a document and its section."""

    document: str
    section: str


class Truth(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One truth file.

    Attributes:
        node: what it is called in the report.
        tree: folder of the checkout below CLONES_DIR, at `commit` (of `ref`).
        package: name of the package.
        module: regular expression over the ids of the modules that are this node.
        files: sources of the node; used when no module id fits.
        documents: what was read.
        complete: roles that the documents claim to list in full; precision is over these.
        interfaces: what the documents name.
        undocumented: what the code at `commit` has and the documents forget; right when extracted.
        absent: what the documents name and the code at `commit` does not have; not asked for.
        notes: where document and code differ, verified by reading the code.
    """

    node: str
    tree: str
    ref: str
    commit: str
    package: str
    module: str
    files: list[str]
    documents: list[Document]
    complete: list[str]
    interfaces: list[Row]
    undocumented: list[Row] = []
    absent: list[Row] = []
    notes: list[str] = []


def load(path: Path) -> Truth:
    """Read a truth file; an unknown key is an error."""
    return msgspec.yaml.decode(path.read_bytes(), type=Truth)


def same_type(documented: str, extracted: str) -> bool:
    """Whether two types are the same; `pkg/Name` and `pkg/msg/Name` are."""
    return _canonical_type(documented) == _canonical_type(extracted)


def _canonical_type(name: str) -> str:
    return _CANONICAL.get(name, re.sub(r"/(?:msg|srv|action)/", "/", name))


def plain(name: str) -> str:
    """A name without the marks of its namespace: `~/a`, `/node/~a` and `a` all end in `a`."""
    return name.replace("~", "").replace("//", "/").strip("/.").replace("/", ".")


def same_name(documented: str, names: tuple[str, ...]) -> bool:
    """Whether one of the names (resolved, raw) is the documented one, below whatever namespace."""
    wanted = plain(documented)
    return any(plain(name) == wanted or plain(name).endswith(f".{wanted}") for name in names)


def covered(documented: str, names: tuple[str, ...]) -> bool:
    """Whether a name with holes could become the documented one, or the documented one is itself a hole."""
    if documented.startswith("{"):
        return any("{" in name for name in names)
    return any(_fits(plain(documented), tail) for name in names for tail in _tails(name))


def _tails(name: str) -> Iterator[str]:
    """A name below each of its namespaces, holes written as NUL."""
    parts = plain(re.sub(r"\{[^{}]*\}", "\0", name)).split(".")
    return (".".join(parts[first:]) for first in range(len(parts)))


def _fits(documented: str, tail: str) -> bool:
    """Whether a tail with holes, and at least three letters besides them, could be the documented name."""
    if "\0" not in tail or len(re.sub(r"\W", "", tail)) < 3:
        return False
    return re.fullmatch(".+".join(re.escape(part) for part in tail.split("\0")), documented) is not None
