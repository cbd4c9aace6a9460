"""Mistakes in overlays: a person has written them, so a person is told of each one, on its line."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ecm_extract.extraction_model import LocatedDiagnostic
from ecm_extract.read.reader import OVERLAY


def is_of_overlay(diagnostic: LocatedDiagnostic) -> bool:
    """Tell whether a diagnostic is about an `ecm.yaml`."""
    return diagnostic.path.rsplit("/", 1)[-1] == OVERLAY


def overlay_problems(diagnostics: Iterable[LocatedDiagnostic]) -> tuple[LocatedDiagnostic, ...]:
    """Return what is wrong with overlays; errors are mistakes, warnings contradict the sources."""
    return tuple(each for each in diagnostics if is_of_overlay(each))


def has_errors(problems: Sequence[LocatedDiagnostic]) -> bool:
    """Tell whether something that was declared could not be used, so that the input is wrong."""
    return any(each.severity == "error" for each in problems)
