"""The extract document."""

from __future__ import annotations

import json

import jsonschema
import msgspec
import pytest
from ecm_checker import json_schema
from ecm_checker.hub.package import Hub, encode_hub
from extractions import BAD_MESSAGE, demo, make_extraction, make_package

from ecm_extract.extraction_model import LocatedDiagnostic
from ecm_extract.report.json_document import extract_document, json_document


def test_document_is_valid() -> None:
    """It passes the schema that is published."""
    schema = jsonschema.Draft202012Validator(json_schema.shipped("extract"))
    assert list(schema.iter_errors(json.loads(json_document(demo())))) == []


def test_document_is_the_same_on_every_run() -> None:
    """Elapsed time and other passing things are not in it."""
    assert json_document(demo()) == json_document(demo())
    assert "elapsed" not in extract_document(demo())


@pytest.mark.parametrize(
    ("paths", "path", "owner"),
    [
        (["a"], "a/x.msg", "a"),
        (["a", "a/b"], "a/b/x.msg", "a/b"),
        (["a"], "ab/x.msg", None),
        (["."], "x.msg", "."),
        ([".", "a"], "a/x.msg", "a"),
        (["a"], "x.msg", None),
    ],
)
def test_diagnostic_stands_with_the_innermost_package(paths: list[str], path: str, owner: str | None) -> None:
    """A reader finds what went wrong beside the modules that it concerns, and nothing is lost."""
    packages = [make_package("p", path=each) for each in paths]
    diagnostic = LocatedDiagnostic("error", "c", path, 1, "m")
    document = extract_document(make_extraction(*packages, diagnostics=(diagnostic,)))
    held = [each["path"] for each in document["packages"] if each["diagnostics"]]
    assert held == ([owner] if owner else [])
    assert len(document["diagnostics"]) == (0 if owner else 1)


def test_a_folder_with_an_undecodable_name_is_written() -> None:
    """Paths come from a file system or a repository and need not be text."""
    diagnostic = LocatedDiagnostic("error", "c", "\udcff/a.msg", 1, "m")
    extraction = make_extraction(make_package("\udcff", path="\udcff"), diagnostics=(diagnostic,))
    document = json.loads(json_document(extraction))
    assert [len(package["diagnostics"]) for package in document["packages"]] == [1]


def test_diagnostic_has_the_published_keys() -> None:
    """Keys are those of the wire format."""
    document = extract_document(make_extraction(diagnostics=(BAD_MESSAGE,)))
    assert document["diagnostics"] == [
        {
            "severity": "error",
            "code": "msg-bad-field",
            "path": "base/msg/A.msg",
            "line": 3,
            "message": "no such type; check the name",
        }
    ]


def test_what_packages_provide_and_require_stays_text() -> None:
    """Read as objects it would be the most of the memory of a run over a large tree."""
    arm = msgspec.structs.replace(make_package("arm"), hub=encode_hub(Hub(quoted=("rate",))))
    extraction = make_extraction(arm, make_package("leg"))
    assert isinstance(extract_document(extraction)["packages"][0]["quoted"], msgspec.Raw)
    first, second = json.loads(json_document(extraction))["packages"]
    assert first["quoted"] == ["rate"]
    assert "quoted" not in second
