"""Frames of which programs tell where they are; one whose name is not known is `<*>`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ecm_checker.hub.provision import HOLE, SENT, Provision

from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts

_HOLE = re.compile(r"\{[^{}]*\}")
_ARROW = " <- "


def transform_entities(facts: PackageFacts, modules: Sequence[LinkedModule]) -> Iterator[Provision]:
    """Yield the child of each transform that a module sends, by the line that sends it."""
    for module in modules:
        for entry in module.interfaces:
            if entry.row.places:
                child = (entry.frame or "").partition(_ARROW)[2].lstrip("/")
                yield Provision(
                    kind=entry.row.places,
                    facet=SENT,
                    package=facts.name,
                    owner="",
                    name=_HOLE.sub(HOLE, child) or HOLE,
                    node=module.node,
                    ros=facts.ros,
                    path=entry.evidence[0].path,
                    line=entry.evidence[0].line,
                    when=entry.when,
                )
