"""What commands say of mistakes in overlays, and the exit status that these have."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

import click

if TYPE_CHECKING:
    from ecm_extract.extraction_model import LocatedDiagnostic

WRONG_INPUT: Final = 2


def tell_overlay_problems(diagnostics: Iterable[LocatedDiagnostic]) -> int:
    """Say on standard error what is wrong with each overlay.

    Returns:
        2 when something that was declared could not be used, else 0.
    """
    from ecm_extract.overlay.problems import has_errors, overlay_problems
    from ecm_extract.report.terminal import one_line

    problems = overlay_problems(diagnostics)
    for each in problems:
        click.echo(one_line(f"{each.path}:{each.line}: {each.severity}: {each.message}", 1000), err=True)
    return WRONG_INPUT if has_errors(problems) else 0
