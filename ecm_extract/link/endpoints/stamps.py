"""Frames that code writes into message headers: `message.header.frame_id = ...`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ecm_checker.contract import Confidence, Evidence
from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.running.values import settled

_HOLDERS = frozenset({"header", "Header"})


class Stamp(NamedTuple):
    """One assignment: the frame, how surely it is known, the line."""

    frame: str
    confidence: Confidence
    evidence: Evidence


def stamps(sites: Sites) -> Iterator[tuple[Cls | Func, Stamp]]:
    """Yield the frames that the units of a program write, each with the class or function that does."""
    for functions in sites.program.functions.values():
        for func in functions:
            for at, statement in enumerate(func.fact.body):
                if statement.kind == "set" and _is_frame(statement.target) and statement.value is not None:
                    for value in map(settled, sites.folder.fold(statement.value, sites.root_env(func, at))):
                        if value.confidence != "pattern" and value.text:
                            evidence = Evidence(func.file.path, statement.line)
                            yield func.holder or func, Stamp(value.text.lstrip("/"), value.confidence, evidence)


def _is_frame(target: Expr | None) -> bool:
    if not isinstance(target, Member) or target.name != "frame_id":
        return False
    base = target.base
    return (isinstance(base, Member) and base.name in _HOLDERS) or (isinstance(base, Name) and base.id in _HOLDERS)
