"""Bases of classes that stand outside of the tree, of which nobody sees what they do."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program


def bases_outside(cls: Cls, program: Program) -> Iterator[str]:
    """Yield the bases of a class, at any distance, that the tree does not have, as they are written."""
    for entry in program.ancestry(cls):
        for base in map(plain, entry.fact.bases):
            if program.class_named(base, entry.file, entry.fact.scope) is None:
                yield base
