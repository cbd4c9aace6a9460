"""JSON Schema (draft 2020-12) of the documents in `wire`: made from the model and shipped as files beside it.

`make schemas` writes the files anew; a test holds them to the model.
"""

from __future__ import annotations

import json
from importlib import resources
from inspect import cleandoc
from typing import Any, Final

import msgspec

from ecm_checker import overlay, profiles, wire
from ecm_checker.hub import package

_DIALECT: Final = "https://json-schema.org/draft/2020-12/schema"
_DOCUMENTS: Final[dict[str, tuple[type[msgspec.Struct], str, str]]] = {
    "manifest": (wire.Manifest, wire.MANIFEST_SCHEMA, "ECM contract of one module"),
    "package": (package.PackageDocument, package.PACKAGE_SCHEMA, "What one package provides and requires"),
    "extract": (package.Extract, wire.EXTRACT_SCHEMA, "What ecm-extract read off one source tree"),
    "evidence": (wire.EvidenceRecord, wire.EVIDENCE_SCHEMA, "What was observed, tested or reviewed of a release"),
    "embodiment": (profiles.Embodiment, "ecm-extract/embodiment/1", "What a robot has"),
    "policy": (profiles.Policy, "ecm-extract/policy/1", "What governance allows"),
    "runtime": (profiles.Runtime, "ecm-extract/runtime/1", "What is installed and holds"),
    "overlay": (overlay.Overlay, overlay.OVERLAY_SCHEMA, "What people declare of the modules of a package"),
    "call": (profiles.Call, "ecm-extract/call/1", "What a caller brings"),
}

NAMES: Final = tuple(_DOCUMENTS)


def generate(name: str) -> dict[str, Any]:
    """JSON Schema of a document (one of `NAMES`), made from the model."""
    model, number, title = _DOCUMENTS[name]
    head = {"$schema": _DIALECT, "$id": f"urn:{number.replace('/', ':')}", "title": title}
    schema: dict[str, Any] = _on_the_left({**head, **msgspec.json.schema(model)})
    return schema


def _on_the_left(part: Any) -> Any:
    """A part of a schema whose descriptions have no indent: msgspec takes docstrings as they stand before 0.23."""
    if isinstance(part, list):
        return [_on_the_left(each) for each in part]
    if not isinstance(part, dict):
        return part
    return {
        key: cleandoc(each) if key == "description" and isinstance(each, str) else _on_the_left(each)
        for key, each in part.items()
    }


def render(name: str) -> str:
    """Text of the file in which the schema of a document is shipped."""
    return json.dumps(generate(name), indent=1) + "\n"


def shipped(name: str) -> dict[str, Any]:
    """JSON Schema of a document as shipped with this package."""
    text = resources.files("ecm_checker").joinpath("schema", f"{name}.schema.json").read_text("utf-8")
    schema: dict[str, Any] = json.loads(text)
    return schema
