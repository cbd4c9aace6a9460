"""Manifests: one YAML document per module."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Contract
from ecm_checker.encode import encode_manifest

from ecm_extract.extraction_model import Extraction
from ecm_extract.report.yaml_text import yaml_document

SUFFIX: Final = ".ecm.yaml"
"""How names of manifest files end."""


def manifest_yaml(contract: Contract) -> str:
    """The manifest of a module; beginning with `---`, so that manifests may be put one after the other."""
    return yaml_document(encode_manifest(contract))


def manifests_yaml(extraction: Extraction) -> Iterator[str]:
    """The manifests of all modules, in the order of the extraction."""
    for package in extraction.packages:
        yield from map(manifest_yaml, package.modules)
