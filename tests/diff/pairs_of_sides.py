"""Provisions of two sides, and how they are paired."""

from __future__ import annotations

from typing import Any

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.model import Pair
from ecm_extract.diff.pair import Pairing
from ecm_extract.diff.still_there import Evidence


def entity(kind: str, name: str, owner: str = "node", **more: Any) -> Provision:
    defaults: dict[str, Any] = {"package": "pkg", "path": "src/node.cpp", "line": 1}
    return Provision(kind=kind, name=name, owner=owner, **(defaults | more))


def paired(old: list[Provision], new: list[Provision], files: dict[str, str] | None = None) -> list[Pair]:
    before = {entry.key: entry for entry in old}
    after = {entry.key: entry for entry in new}
    return Pairing(before, after, Evidence(files or {})).run()


def shown(pairs: list[Pair]) -> list[tuple[str | None, str | None, str]]:
    names = [(pair.old.name if pair.old else None, pair.new.name if pair.new else None, pair.how) for pair in pairs]
    return sorted(names, key=str)
