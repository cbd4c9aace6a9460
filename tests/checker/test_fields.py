"""The table of contract fields."""

from __future__ import annotations

import msgspec
import pytest
from ecm_checker.contract import Contract, Identity, Recovery, Signature, Source, Value
from ecm_checker.fields import FIELDS, missing_fields, required_fields


def make_contract(**sections: msgspec.Struct) -> Contract:
    identity = Identity("ecm.a.b", "a", "node", None, Source(None, None, "."), 2)
    return Contract(identity, **sections)  # type: ignore[arg-type]


def test_every_row_is_a_field_of_the_model() -> None:
    """A row that names no field would make every contract incomplete for ever."""
    contract = make_contract()
    for row in FIELDS:
        section, field = row.path.split(".")
        assert hasattr(getattr(contract, section), field), row.path


def test_every_field_of_the_model_has_a_row() -> None:
    """A field without a row would never be explained nor be found missing."""
    contract = make_contract()
    sections = ("signature", "behavior", "resources", "permissions", "recovery", "versioning")
    fields = {f"{section}.{field}" for section in sections for field in getattr(contract, section).__struct_fields__}
    lists = {"signature.interfaces", "versioning.entities", "versioning.uses"}
    assert fields - lists == {row.path for row in FIELDS if not row.path.startswith("ecm.")}


def test_the_paper_requires_twenty_fields() -> None:
    """The Req. column of the paper's table has twenty fields marked Y."""
    assert len(required_fields()) == 20


@pytest.mark.parametrize("path", ["ecm.version", "signature.timeout_ms", "recovery.failure_modes"])
def test_an_undeclared_required_field_is_missing(path: str) -> None:
    """Undeclared is None."""
    assert path in missing_fields(make_contract())


def test_an_empty_list_is_not_missing() -> None:
    """Undeclared is never the same as none."""
    none_at_all = Value([], "inferred")
    missing = missing_fields(make_contract(recovery=Recovery(failure_modes=none_at_all)))
    assert "recovery.failure_modes" not in missing


def test_optional_fields_are_never_missing() -> None:
    """Only required fields make a contract incomplete."""
    missing = missing_fields(make_contract(signature=Signature()))
    assert not set(missing) & {row.path for row in FIELDS if not row.required}


@pytest.mark.parametrize("kind", ["interface", "launch", "library"])
def test_what_does_not_run_has_no_behavior_to_declare(kind: str) -> None:
    """An interface package was asked for preconditions and a retry policy."""
    wanted = required_fields(kind)
    assert {path.partition(".")[0] for path in wanted} == {"ecm", "versioning"}
    contract = make_contract()
    other = msgspec.structs.replace(contract, ecm=msgspec.structs.replace(contract.ecm, kind=kind))
    assert set(missing_fields(other)) < set(missing_fields(contract))


@pytest.mark.parametrize("kind", ["node", "component", "nodelet", "script", "controller", "hardware", "plugin", "new"])
def test_what_runs_needs_all(kind: str) -> None:
    """A kind that is not known is not excused from anything."""
    assert required_fields(kind) == required_fields()
