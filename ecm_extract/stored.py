"""Stored documents: packages as they were extracted once, read without their sources."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Final

import msgspec
from ecm_checker.hub.kinds import kinds
from ecm_checker.hub.package import SUFFIX, Extract, Hub, Package, SchemaError, decode_documents, provisions
from ecm_checker.hub.provision import Key, Provision
from ecm_checker.match.consumer import Consumer
from ecm_checker.wire import NotRead
from ecm_parsers.interface_facts import Definition

from ecm_extract.collector import without_collector
from ecm_extract.entities.side import PackageInfo, Side
from ecm_extract.errors import InputError
from ecm_extract.extraction_model import Extraction, LocatedDiagnostic, PackageContracts, sorted_diagnostics
from ecm_extract.package_paths import concerns
from ecm_extract.report.json_document import DOCUMENT_NAME
from ecm_extract.report.manifest_yaml import SUFFIX as MANIFEST
from ecm_extract.tree import Tree, Unread
from ecm_extract.tree.blobs import BlobTree
from ecm_extract.tree.git_repo import GitRepo
from ecm_extract.tree.unread import not_read, unread_in

MAX_BYTES: Final = 500_000_000
_JSON: Final = ".json"
_MANIFESTS: Final = frozenset({"package.xml", "manifest.xml"})
_KEPT: Final = (SUFFIX, DOCUMENT_NAME, MANIFEST)
"""How files end of which a folder of documents holds some."""


class Stored(msgspec.Struct, frozen=True, dict=True):
    """Packages of one tree as documents hold them.

    Attributes:
        label: how the user named them. commit: that they were read at; None of a work tree.
        packages: sorted by path. unread: what was not read of the tree.
        source: how the tree was called when it was read. diagnostics: sorted, what was said of it then.
    """

    label: str
    commit: str | None
    packages: tuple[Package, ...]
    unread: tuple[Unread, ...] = ()
    source: str = ""
    diagnostics: tuple[LocatedDiagnostic, ...] = ()

    @cached_property
    def files(self) -> Mapping[str, str]:
        """Blob id of each file of its packages, sorted by path; empty where it is not known."""
        found = {path: blob for package in self.packages for path, blob in package.files.items()}
        return {path: found[path] for path in sorted(found)}


def is_stored(spec: str) -> bool:
    """Tell whether a path is a document, or a folder of documents or manifests without sources."""
    place = Path(spec)
    if place.is_file():
        return place.suffix == _JSON
    if not place.is_dir():
        return False
    kept = False
    for _, _, names in os.walk(place):
        if not _MANIFESTS.isdisjoint(names):
            return False
        kept = kept or any(name.endswith(_KEPT) for name in names)
    return kept


def read_stored(spec: str) -> Stored:
    """Read documents.

    Args:
        spec: an extract document, that of a package, or a folder of these.

    Raises:
        InputError: one is none, or of another schema number; the message names it and what to do.
    """
    place = Path(spec)
    files = [place] if place.is_file() else _files(place, f"*{SUFFIX}") or _files(place, DOCUMENT_NAME)
    if not files:
        message = f"{spec} holds manifests and no document of a package (*{SUFFIX} or {DOCUMENT_NAME})"
        raise InputError(message, "an older version wrote them; extract the package once more")
    read = [_read(path) for path in files]
    commits = {found.commit for found in read}
    packages = tuple(sorted((each for found in read for each in found.packages), key=lambda each: each.path))
    unread = dict.fromkeys(each for found in read for each in found.unread)
    source = ", ".join(dict.fromkeys(found.source for found in read))
    diagnostics = sorted_diagnostics(each for found in read for each in found.diagnostics)
    commit = commits.pop() if len(commits) == 1 else None
    return Stored(spec, commit, packages, tuple(unread), source, diagnostics)


def joined(stored: Sequence[Stored]) -> Stored:
    """Return documents of several trees as those of one; of each package the first."""
    if len(stored) == 1:
        return stored[0]
    packages = {package.name: package for each in reversed(stored) for package in each.packages}
    return Stored(
        label=", ".join(each.label for each in stored),
        commit=None,
        packages=tuple(sorted(packages.values(), key=lambda each: each.path)),
        unread=tuple(dict.fromkeys(row for each in stored for row in each.unread)),
        source=", ".join(dict.fromkeys(each.source for each in stored)),
        diagnostics=sorted_diagnostics(row for each in stored for row in each.diagnostics),
    )


def _files(folder: Path, pattern: str) -> list[Path]:
    return sorted(path for path in folder.rglob(pattern) if path.is_file())


def _read(path: Path) -> Stored:
    try:
        if path.stat().st_size > MAX_BYTES:
            message = f"{path} is larger than {MAX_BYTES} bytes"
            raise InputError(message)
        with without_collector():
            document = decode_documents(path.read_bytes())
    except OSError as error:
        message = f"cannot read {path}: {error.strerror}"
        raise InputError(message) from error
    except (SchemaError, msgspec.MsgspecError, RecursionError) as error:
        message = f"{path} cannot be read: {error}"
        raise InputError(message, "write it anew with `ecm-extract PATH --format json`") from error
    packages = document.packages if isinstance(document, Extract) else (document,)
    unread = unread_in(document.unread)
    said = (each for held in (document, *packages) for each in held.diagnostics)
    diagnostics = sorted_diagnostics(msgspec.convert(each, LocatedDiagnostic, from_attributes=True) for each in said)
    return Stored(str(path), document.source.commit, packages, unread, document.source.path, diagnostics)


def packages_of(extraction: Extraction) -> tuple[Package, ...]:
    """Return the packages of a tree that was just read, with what they provide and require, as documents do."""
    paths = {each.path for each in extraction.packages}
    rows = not_read(extraction.unread)
    return tuple(
        package_of(each, tuple(row for row in rows if concerns(row.path, each.path, paths)))
        for each in extraction.packages
    )


def package_of(extracted: PackageContracts, unread: tuple[NotRead, ...] = ()) -> Package:
    """Return one such package."""
    hub = msgspec.json.decode(extracted.hub, type=Hub) if extracted.hub else Hub()
    head = {"name": extracted.name, "version": extracted.version, "path": extracted.path, "ros": extracted.ros}
    return Package(**head, **msgspec.structs.asdict(hub), unread=unread)  # type: ignore[arg-type]


def stored_side(stored: Stored) -> Side:
    """Return what stored packages offer, as a comparison reads it."""
    entities: dict[Key, Provision] = {}
    for package in sorted(stored.packages, key=lambda each: each.name):  # as sources give them
        rows = provisions(package.name, package)
        entities |= {key: each for key, each in rows.items() if kinds()[each.kind].compared}
    notes = {path: lines for package in stored.packages for path, lines in package.notes.items()}
    return Side(
        commit=stored.commit,
        packages={each.name: _info(each) for each in stored.packages},
        entities=entities,
        interfaces=dict(_interfaces(stored.packages)),
        paths=frozenset(stored.files),
        blobs={path: blob for path, blob in stored.files.items() if blob},
        bound=frozenset(name for each in stored.packages for name in each.bound),
        quoted=frozenset(name for each in stored.packages for name in each.quoted),
        reads=frozenset(_reads(stored.packages)),
        notes=lambda paths: {path: notes[path] for path in paths if path in notes},
    )


def contents_of(stored: Stored, repo: GitRepo) -> Tree:
    """Return the files of stored packages as far as a repository holds their content."""
    return BlobTree(repo, stored.files, label=stored.label, commit=stored.commit)


def stored_consumers(stored: Stored) -> list[Consumer]:
    """Return stored packages as consumers."""
    return [Consumer(package.name, package.requires, package.ros) for package in stored.packages]


def _info(package: Package) -> PackageInfo:
    path = "" if package.path == "." else package.path
    return PackageInfo(package.name, package.version, path, package.manifest, package.ros)


def _interfaces(packages: Sequence[Package]) -> Iterator[tuple[str, Definition]]:
    for package in packages:
        for name, data in package.interfaces.items():
            yield name, msgspec.convert(data, Definition)


def _reads(packages: Sequence[Package]) -> Iterator[tuple[str, str]]:
    for package in packages:
        for requirement in package.requires:
            if requirement.row.reads:
                yield package.name, requirement.name
