"""Manifests as YAML."""

from __future__ import annotations

from collections.abc import Callable

import jsonschema
import yaml
from ecm_checker import json_schema
from ecm_checker.encode import decode
from extractions import CMD_VEL, COMPUTED, demo, make_module

from ecm_extract.report.manifest_yaml import manifest_yaml, manifests_yaml


def test_manifest_reads_well(golden: Callable[[str, str], None]) -> None:
    """What a person sees when opening a manifest."""
    golden("manifest.ecm.yaml", manifest_yaml(make_module("base", "driver", CMD_VEL, COMPUTED)))


def test_manifest_is_read_back() -> None:
    """A manifest in a folder is as good as the contract that it was written from."""
    module = make_module("base", "driver", CMD_VEL, COMPUTED)
    plain = yaml.safe_load(manifest_yaml(module))
    jsonschema.validate(plain, json_schema.shipped("manifest"))
    assert decode(plain) == module


def test_manifests_may_be_joined() -> None:
    """`-o -` writes one stream of documents."""
    stream = "".join(manifests_yaml(demo()))
    assert [plain["ecm"]["module_id"] for plain in yaml.safe_load_all(stream)] == ["ecm.base.driver"]
