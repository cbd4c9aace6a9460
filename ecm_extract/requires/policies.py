"""SROS 2 policies: the nodes that they give permissions to."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.requirement import Requirement

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required


def policy_requirements(facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the policies of a package require, each node of a file once."""
    for path, grants in facts.grants.items():
        nodes: dict[str, int] = {}
        for grant in grants:
            nodes.setdefault(grant.node.rpartition("/")[2], grant.line)
        for name, line in nodes.items():
            yield required("grants", name, Place(path, line, f"policy {path}"))
