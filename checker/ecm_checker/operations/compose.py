"""ComposeCompat(ei, ej, R, P) = SigMatch and BehMatch and ResJointSat and PermChainSafe and RecMatch."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_checker.case import Case
from ecm_checker.finding import Dimension
from ecm_checker.operations.engine import ALL, Subject, examine, ready, report
from ecm_checker.outcome import Report
from ecm_checker.profiles import NO_PROFILES, Profiles


def compose(
    first: Subject,
    second: Subject,
    profiles: Profiles = NO_PROFILES,
    dimensions: Sequence[Dimension] = ALL,
) -> Report:
    """May two modules run together, the first handing over to the second?

    Args:
        first: contract, or a view made of it.
        second: the one that comes after it.
        profiles: of robot, governance and installation.
        dimensions: those to consult, of the ones that the operation consults.
    """
    case = Case((ready(first), ready(second)), profiles, ordered=True)
    return report("compose", examine("compose", case, dimensions), profiles, dimensions)
