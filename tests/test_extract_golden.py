"""The whole document of the demo robot, as other programs read it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
from ecm_checker import json_schema
from jsonschema import Draft202012Validator

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.report.json_document import json_document
from ecm_extract.tree import open_tree

DEMO = Path(__file__).parent.parent / "fixtures" / "demo_robot"


def document(jobs: int) -> dict[str, Any]:
    tree = open_tree(DEMO)
    tree.commit, tree.repository = None, None
    extraction = extract(tree, Options(jobs=jobs))
    decoded: dict[str, Any] = msgspec.json.decode(json_document(msgspec.structs.replace(extraction, path="demo_robot")))
    return decoded


def test_the_document_of_the_demo_robot(golden: Any) -> None:
    """Every endpoint, parameter, type, QoS policy and line of the demo is in the document."""
    golden("demo_robot.json", msgspec.json.format(msgspec.json.encode(document(1)), indent=1).decode() + "\n")


def test_the_document_is_the_same_with_any_number_of_processes() -> None:
    """Same input, same bytes."""
    assert document(1) == document(3)


def test_the_document_is_valid() -> None:
    """What is written holds to the schema that is shipped."""
    assert list(Draft202012Validator(json_schema.shipped("extract")).iter_errors(document(1))) == []
