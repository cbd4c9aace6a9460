"""The published JSON Schemas."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

import ecm_checker
import jsonschema
import pytest
from ecm_checker import json_schema
from ecm_checker.contract import Contract, Identity, Source
from ecm_checker.encode import encode, encode_manifest

MODULE = Contract(Identity("ecm.a.b", "a", "node", None, Source(None, None, "."), 2))


class Checks(Protocol):
    def check(self, path: Path, text: str) -> None: ...


def extract_document(**changes: Any) -> dict[str, Any]:
    package = {
        "name": "a",
        "version": None,
        "path": ".",
        "ros": 2,
        "modules": [encode(MODULE)],
        "diagnostics": [],
    }
    source = {"path": "/tmp/a", "commit": None}
    return {"schema": "ecm-extract/extract/1", "source": source, "packages": [package], **changes}


@pytest.mark.parametrize("name", json_schema.NAMES)
def test_shipped_schema_is_that_of_the_model(name: str, golden: Checks) -> None:
    """The file that others read says what the code writes; `make schemas` updates it."""
    folder = Path(ecm_checker.__file__).parent / "schema"
    golden.check(folder / f"{name}.schema.json", json_schema.render(name))


@pytest.mark.parametrize("name", json_schema.NAMES)
def test_shipped_schema_is_a_schema(name: str) -> None:
    """It is valid against draft 2020-12 itself."""
    schema = json_schema.shipped(name)
    assert list(jsonschema.Draft202012Validator(jsonschema.Draft202012Validator.META_SCHEMA).iter_errors(schema)) == []


def test_documents_are_valid() -> None:
    """What is written passes the schema that is published."""
    for name, document in (("manifest", encode_manifest(MODULE)), ("extract", extract_document())):
        assert list(jsonschema.Draft202012Validator(json_schema.shipped(name)).iter_errors(document)) == []


@pytest.mark.parametrize(
    "changes",
    [{"schema": "ecm-extract/extract/2"}, {"packages": None}, {"source": {"path": 3, "commit": None}}],
)
def test_a_wrong_document_is_refused(changes: dict[str, Any]) -> None:
    """The schema is strict enough to tell another version or a broken document."""
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(extract_document(**changes), json_schema.shipped("extract"))
