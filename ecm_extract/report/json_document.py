"""The extract document: all that was read off a tree as one JSON document (`ecm-extract/extract/1`)."""

from __future__ import annotations

from typing import Any, Final

import msgspec
from ecm_checker.encode import encode
from ecm_checker.hub.package import PACKAGE_SCHEMA
from ecm_checker.json_data import json_data, record_data
from ecm_checker.wire import EXTRACT_SCHEMA, Origin

from ecm_extract.extraction_model import Extraction, PackageContracts
from ecm_extract.package_paths import concerns, owner_of

DOCUMENT_NAME: Final = "extract.json"
"""How the document is called in a folder."""


def extract_document(extraction: Extraction) -> dict[str, Any]:
    """Data of the extract document; what packages provide and require is JSON text in it.

    A diagnostic stands with the innermost package whose folder holds its file; `diagnostics` of the document
    holds the rest.
    """
    held = _by_package(extraction)
    return {
        "schema": EXTRACT_SCHEMA,
        "source": record_data(Origin(extraction.path, extraction.commit)),
        "packages": [_package(each, held.get(each.path, [])) for each in extraction.packages],
        "diagnostics": held.get(None, []),
        "unread": [json_data(each) for each in extraction.unread],
    }


def json_document(extraction: Extraction) -> bytes:
    """The extract document as UTF-8 text, indented by one space, with a newline at its end."""
    return msgspec.json.format(msgspec.json.encode(extract_document(extraction)), indent=1) + b"\n"


def _package(package: PackageContracts, diagnostics: list[dict[str, Any]]) -> dict[str, Any]:
    head = json_data({"name": package.name, "version": package.version, "path": package.path, "ros": package.ros})
    modules = [encode(module) for module in package.modules]
    # Its parts are canonical JSON already: read as objects they would be the most of the memory of a run.
    hub = msgspec.json.decode(package.hub, type=dict[str, msgspec.Raw]) if package.hub else {}
    return {**head, "modules": modules, **hub, "diagnostics": diagnostics}


def package_document(extraction: Extraction, package: PackageContracts) -> bytes:
    """The document of one package as canonical JSON: equal content gives equal bytes."""
    by_package = _by_package(extraction)
    held = [*by_package.get(None, []), *by_package.get(package.path, [])]
    source = record_data(Origin(extraction.path, extraction.commit))
    paths = {each.path for each in extraction.packages}
    unread = [json_data(each) for each in extraction.unread if concerns(each.path, package.path, paths)]
    whole = {"schema": PACKAGE_SCHEMA, "source": source, **_package(package, held), "unread": unread}
    return msgspec.json.encode(whole, order="deterministic") + b"\n"


def _by_package(extraction: Extraction) -> dict[str | None, list[dict[str, Any]]]:
    paths = {package.path for package in extraction.packages}
    held: dict[str | None, list[dict[str, Any]]] = {}
    for diagnostic in extraction.diagnostics:
        held.setdefault(owner_of(diagnostic.path, paths), []).append(record_data(diagnostic))
    return held
