"""The document of a package: all that others ask of it, so that its sources need not be read again.

One file a package beside its manifests, and the same keys in the extract document. Equal content gives equal bytes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Final, Literal

import msgspec
from msgspec import UNSET, UnsetType

from ecm_checker.contract import Confidence, Contract, Evidence, Qos
from ecm_checker.encode import decode as decode_contract
from ecm_checker.hub.condition import Condition
from ecm_checker.hub.provision import Form, Key, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.running import Running
from ecm_checker.json_data import json_data
from ecm_checker.wire import EXTRACT_SCHEMA, Diagnostic, Module, NotRead, Origin

PACKAGE_SCHEMA: Final = "ecm-extract/package/1"
SUFFIX: Final = ".package.json"
"""How names of package documents end."""


class Provided(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, gc=False):
    """A provision as it is written; the attributes are those of `Provision`, its lines are `evidence`.

    `conditions` are those of `when` in words.
    """

    kind: str
    owner: str
    name: str
    type: str | None
    default: Any
    conditions: tuple[str, ...]
    confidence: Confidence
    deprecated: str | None
    evidence: tuple[Evidence, ...]
    facet: str = ""
    node: str | None = None
    sharers: tuple[str, ...] = ()
    others: tuple[str, ...] = ()
    forms: tuple[Form, ...] = ()
    bases: tuple[str, ...] = ()
    given: tuple[tuple[str, ...], ...] = ()
    qos: Qos | None = None
    ros: int | None = None
    advised: tuple[str, ...] = ()
    open: bool = False
    written: str = ""
    when: tuple[Condition, ...] = ()
    needed: bool = False


class Around(msgspec.Struct, frozen=True, omit_defaults=True):
    """What the tree of a package says outside of its packages, for all that lies in it.

    Attributes:
        distributions: that it says to be for, sorted. fetched: names of repositories that it fetches beside, sorted.
    """

    distributions: tuple[str, ...] = ()
    fetched: tuple[str, ...] = ()


class Hub(msgspec.Struct, frozen=True, kw_only=True):
    """What a package provides and requires, and what two releases of it are compared by beside.

    Attributes:
        manifest: path of its package.xml; None without one.
        provides, requires: in the order of files and lines.
        bound: dotted names that its Python modules offer without declaring them.
        quoted: dotted names that its Python modules give by text, as a class decorator does.
        interfaces: what its interface files declare, by `package/msg|srv|action/Name`.
        files: git blob id of each file by path, empty where it is not known; files that concern all packages of the
            tree, as its changelogs and launch files outside of packages do, are of each.
        notes: sentences of changelogs, by path.
        possible: names by kind that its build may make beside what it provides, such as programs that it does not
            install; of files, below its share folder, a path that ends in a slash stands for all below it.
        open: kinds of which it may have any name, as where its build is not understood.
        runs_files: whether any of its files may be started by its name.
        makes_files: whether its build may make files, or put some where nothing tells.
        tells_installed: whether all that it installs is known, and there is something.
        unbuilt: sources of C++ that no target of it has, by path.
        around: what its tree says for all packages in it; absent where it says nothing.
        running: what launch files need of it; documents of older versions and those of a corpus have none.
    """

    manifest: str | None = None
    provides: tuple[Provided, ...] = ()
    requires: tuple[Requirement, ...] = ()
    bound: tuple[str, ...] = ()
    quoted: tuple[str, ...] = ()
    interfaces: dict[str, Any] = {}
    files: dict[str, str] = {}
    notes: dict[str, tuple[str, ...]] = {}
    possible: dict[str, tuple[str, ...]] = {}
    open: tuple[str, ...] = ()
    runs_files: bool = True
    makes_files: bool = True
    tells_installed: bool = False
    unbuilt: tuple[str, ...] = ()
    around: Around | UnsetType = UNSET
    running: Running | UnsetType = UNSET


class Package(Hub, frozen=True, kw_only=True):
    """One ROS package with its modules, and what could not be read of it.

    Attributes:
        name: as in package.xml. version: None when it declares none.
        path: of its folder in the tree. ros: 1 or 2; None when no artefact tells.
        modules: their contracts.
        diagnostics: what was said of its files; in a document of its own also what was said of none of any package.
        unread: what was not read of it, or of its tree outside of packages.
    """

    name: str
    version: str | None
    path: str
    ros: Literal[1, 2] | None
    modules: tuple[Module, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    unread: tuple[NotRead, ...] = ()

    @property
    def shared(self) -> frozenset[str]:
        """Its files and folders, from its own folder."""
        root = f"{self.path}/" if self.path else ""
        files = [path.removeprefix(root) for path in self.files if path.startswith(root)]
        return frozenset(files).union(folder for path in files for folder in folders_of(path))

    def inside(self, path: str) -> str:
        """Return a path of the tree from its own folder."""
        return path.removeprefix(f"{self.path}/") if self.path not in {"", "."} else path

    def holds(self, path: str) -> bool:
        """Tell whether a path of the tree is below its folder."""
        return self.path in {"", "."} or path.startswith(f"{self.path}/")

    @property
    def gaps(self) -> tuple[NotRead, ...]:
        """What could declare interfaces of it and was not read."""
        return tuple(each for each in self.unread if each.is_gap)

    def contracts(self) -> tuple[Contract, ...]:
        """Return the contracts of its modules."""
        return tuple(decode_contract(msgspec.to_builtins(module)) for module in self.modules)


class PackageDocument(Package, frozen=True, kw_only=True):
    """A package in a file of its own, with the tree that it was read of."""

    schema: Literal["ecm-extract/package/1"]
    source: Origin


class Extract(msgspec.Struct, frozen=True, kw_only=True):
    """Everything that was read off one tree; `diagnostics` holds those of files that are in no package."""

    schema: Literal["ecm-extract/extract/1"]
    source: Origin
    packages: tuple[Package, ...]
    diagnostics: tuple[Diagnostic, ...] = ()
    unread: tuple[NotRead, ...] = ()


def folders_of(path: str) -> Iterator[str]:
    """Yield the folders around a path, the outermost first: `a` and `a/b` of `a/b/c`."""
    yield from (path[:at] for at, char in enumerate(path) if char == "/" and at)


class SchemaError(ValueError):
    """A document has another schema number than this version reads."""


def provided(provision: Provision) -> Provided:
    """Return a provision as it is written."""
    first = (provision.path, provision.line)
    lines = dict.fromkeys((first, *provision.chain))
    return Provided(
        kind=provision.kind,
        owner=provision.owner,
        name=provision.name,
        type=provision.type,
        default=json_data(provision.default),
        conditions=tuple(each.text for each in provision.when),
        confidence=provision.confidence,
        deprecated=provision.deprecated,
        evidence=tuple(Evidence(path, line) for path, line in lines),
        facet=provision.facet,
        node=provision.node,
        sharers=provision.sharers,
        others=provision.others,
        forms=provision.forms,
        bases=provision.bases,
        given=provision.given,
        qos=provision.qos,
        ros=provision.ros,
        advised=provision.advised,
        open=provision.open,
        written=provision.written,
        when=provision.when,
        needed=provision.needed,
    )


def provision(package: str, row: Provided) -> Provision:
    """Return what a row of a package's document provides."""
    first = row.evidence[0]
    chain = tuple((at.path, at.line) for at in row.evidence) if len(row.evidence) > 1 else ()
    return Provision(
        kind=row.kind,
        package=package,
        owner=row.owner,
        name=row.name,
        path=first.path,
        line=first.line,
        facet=row.facet,
        node=row.node,
        sharers=row.sharers,
        others=row.others,
        chain=chain,
        type=row.type,
        default=row.default,
        forms=row.forms,
        bases=row.bases,
        given=row.given,
        qos=row.qos,
        ros=row.ros,
        advised=row.advised,
        deprecated=row.deprecated,
        confidence=row.confidence,
        open=row.open,
        written=row.written,
        when=row.when,
        needed=row.needed,
    )


def provisions(package: str, hub: Hub) -> dict[Key, Provision]:
    """Return what a package provides, by key."""
    found = (provision(package, row) for row in hub.provides)
    return {each.key: each for each in found}


def encode_hub(hub: Hub) -> bytes:
    """Return the keys of a hub as canonical JSON."""
    try:
        return msgspec.json.encode(hub, order="deterministic")
    except UnicodeEncodeError:  # somebody's file names and texts may be no Unicode
        return msgspec.json.encode(json_data(hub), order="deterministic")


def decode_documents(data: bytes) -> Extract | PackageDocument:
    """Read an extract document or that of one package.

    Raises:
        SchemaError: it is of another schema number, or none.
        msgspec.ValidationError: a key is missing or has a wrong type; the message names its path.
        msgspec.DecodeError: it is not JSON.
    """
    if data.startswith(_EXTRACT):  # as they are written; to look for the schema first would read them twice
        return msgspec.json.decode(data, type=Extract)
    schema = msgspec.json.decode(data, type=_Head).schema
    model = _MODELS.get(schema)
    if model is None:
        message = f"its schema is {schema or 'not told'}; this version reads {' and '.join(_MODELS)}"
        raise SchemaError(message)
    return msgspec.json.decode(data, type=model)


_EXTRACT: Final = f'{{\n "schema": "{EXTRACT_SCHEMA}",'.encode()


class _Head(msgspec.Struct):
    schema: str = ""


_MODELS: Final[Mapping[str, type[Extract] | type[PackageDocument]]] = {
    EXTRACT_SCHEMA: Extract,
    PACKAGE_SCHEMA: PackageDocument,
}
