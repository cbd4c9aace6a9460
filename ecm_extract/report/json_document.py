"""The extract document: all that was read off a tree as one JSON document (`ecm-extract/extract/1`)."""

from __future__ import annotations

from typing import Any

import msgspec
from ecm_checker.encode import encode
from ecm_checker.json_data import record_data
from ecm_checker.wire import EXTRACT_SCHEMA, Origin, Package

from ecm_extract.extraction_model import Extraction, LocatedDiagnostic, PackageContracts


def extract_document(extraction: Extraction) -> dict[str, Any]:
    """Plain data of the extract document.

    A diagnostic stands with the innermost package whose folder holds its file; `diagnostics` of the document
    holds the rest.
    """
    held = _by_package(extraction)
    return {
        "schema": EXTRACT_SCHEMA,
        "source": record_data(Origin(extraction.path, extraction.commit)),
        "packages": [_package(each, held.get(each.path, [])) for each in extraction.packages],
        "diagnostics": held.get(None, []),
    }


def json_document(extraction: Extraction) -> bytes:
    """The extract document as UTF-8 text, indented by one space, with a newline at its end."""
    return msgspec.json.format(msgspec.json.encode(extract_document(extraction)), indent=1) + b"\n"


def _package(package: PackageContracts, diagnostics: list[dict[str, Any]]) -> dict[str, Any]:
    head = Package(package.name, package.version, package.path, package.ros, (), ())
    modules = [encode(module) for module in package.modules]
    return {**record_data(head), "modules": modules, "diagnostics": diagnostics}


def _by_package(extraction: Extraction) -> dict[str | None, list[dict[str, Any]]]:
    paths = {package.path for package in extraction.packages}
    held: dict[str | None, list[dict[str, Any]]] = {}
    for diagnostic in extraction.diagnostics:
        held.setdefault(_owner(diagnostic, paths), []).append(record_data(diagnostic))
    return held


def _owner(diagnostic: LocatedDiagnostic, paths: set[str]) -> str | None:
    folder = diagnostic.path
    while folder:
        folder = folder.rpartition("/")[0]
        if folder in paths:
            return folder
    return "." if "." in paths else None
