"""Profiles: their schema, their page, and the simpler checkers to compare with."""

from __future__ import annotations

import re
from typing import Any

import jsonschema
import msgspec
import pytest
import yaml
from ecm_checker import json_schema
from ecm_checker.baselines import schema_and_qos, schema_only
from ecm_checker.profiles import Call, Embodiment, Policy, Runtime
from rule_fixtures import ROOT, RULES, contract, load

KINDS: dict[str, Any] = {"embodiment": Embodiment, "policy": Policy, "runtime": Runtime, "call": Call}


def examples() -> dict[str, Any]:
    """Examples of the manual, by kind."""
    page = (ROOT / "docs" / "profiles.md").read_text("utf-8")
    blocks = re.findall(r"## (\w+).*?```yaml\n(.*?)```", page, re.DOTALL)
    return {name.lower(): yaml.safe_load(text) for name, text in blocks}


@pytest.mark.parametrize("kind", KINDS)
def test_example_of_the_manual_names_every_field_and_is_valid(kind: str) -> None:
    """Who copies the example gets a profile that is read."""
    example = examples()[kind]
    assert set(example) == set(KINDS[kind].__struct_fields__)
    jsonschema.validate(example, json_schema.shipped(kind))
    assert msgspec.convert(example, KINDS[kind])


@pytest.mark.parametrize("kind", KINDS)
def test_fixtures_fit_the_schema(kind: str) -> None:
    """The schema that is shipped accepts what the checker reads, and refuses a misspelt key."""
    for path in (ROOT / "fixtures").rglob(f"{kind}.yaml"):
        jsonschema.validate(load(path), json_schema.shipped(kind))
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({"sensor": []}, json_schema.shipped(kind))


@pytest.mark.parametrize(
    ("rule", "schema", "qos"),
    [("SIG001", "reject", "reject"), ("BEH001", "accept", "reject"), ("RES001", "accept", "accept")],
)
def test_baselines_see_less(rule: str, schema: str, qos: str) -> None:
    """Types only; types and QoS; neither sees a double claim."""
    modules = [contract(path) for path in sorted((RULES / rule / "bad").glob("*.ecm.yaml"))]
    assert schema_only(modules) == schema
    assert schema_and_qos(modules) == qos
