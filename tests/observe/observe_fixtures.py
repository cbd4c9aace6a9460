"""Observations and contracts in a short form: what a test leaves out has a plain value."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import msgspec
import yaml
from ecm_checker.contract import Contract
from ecm_checker.encode import decode

from ecm_extract.observe.model import Observation
from ecm_extract.observe.watch import Watch

ROOT = Path(__file__).parents[2]
RULES = ROOT / "fixtures" / "observe" / "rules"


def observation(**given: Any) -> Observation:
    plain = {"source": "dds", "target": "test", "ros": 2, "begun": "2026-01-01T00:00:00Z", "seconds": 2.0, "senses": []}
    return msgspec.convert({**plain, **given}, Observation)


def contract(given: dict[str, Any], ros: int = 2) -> Contract:
    """A contract from `id`, `interfaces` and sections in their wire form."""
    package = given["id"].split(".")[1]
    identity = {"module_id": given["id"], "package": package, "kind": given.get("kind", "node"), "version": "1.0.0"}
    source = {"repository": None, "commit": None, "path": package}
    sections = {key: value for key, value in given.items() if key not in {"id", "kind", "interfaces"}}
    sections["signature"] = {"interfaces": [_interface(each) for each in given.get("interfaces", ())]}
    return decode({"ecm": {**identity, "source": source, "ros": ros}, **sections})


def _interface(given: dict[str, Any]) -> dict[str, Any]:
    plain = {"qos": None, "frame": None, "confidence": "literal", "evidence": [{"path": "src/a.cpp", "line": 10}]}
    return {**plain, "raw_name": given["name"].lstrip("/"), **given}


def watch(given: dict[str, Any]) -> Watch:
    """A watch from `seen`, `contracts` and `launched`."""
    seen = observation(**given["seen"])
    return Watch(seen, contracts(given.get("contracts", ()), seen.ros or 2), launched=given.get("launched", False))


def contracts(given: Iterable[dict[str, Any]], ros: int = 2) -> list[Contract]:
    return [contract(each, ros) for each in given]


def load(path: Path) -> Watch:
    return watch(yaml.safe_load(path.read_text("utf-8")))
