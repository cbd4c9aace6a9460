"""UpgradeCompat(ev, ev', R, P, D) = DepSat, DepPreserve, PermDeltaSafe, ResDeltaSafe and RecDeltaSafe."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ecm_checker.case import Case
from ecm_checker.finding import Dimension
from ecm_checker.operations.engine import ALL, Subject, examine, ready, report
from ecm_checker.outcome import Report
from ecm_checker.profiles import NO_PROFILES, Profiles


def upgrade(
    old: Subject,
    new: Subject,
    profiles: Profiles = NO_PROFILES,
    dependents: Iterable[Subject] | None = None,
    dimensions: Sequence[Dimension] = ALL,
) -> Report:
    """May a module be replaced by a newer version?

    Args:
        old: contract, or a view made of it.
        new: the one that replaces it.
        profiles: of robot, governance and installation.
        dependents: modules that use the old version; None when they are not known.
        dimensions: those to consult, of the ones that the operation consults.
    """
    users = None if dependents is None else tuple(ready(module) for module in dependents)
    case = Case((ready(new),), profiles, previous=ready(old), dependents=users)
    return report("upgrade", examine("upgrade", case, dimensions), profiles, dimensions)
