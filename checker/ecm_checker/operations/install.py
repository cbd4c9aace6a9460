"""InstallCompat(e, R, P) = DepSat and ResSat and PermSat and Complete and LockSafe."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_checker.case import Case
from ecm_checker.finding import Dimension
from ecm_checker.operations.engine import ALL, Subject, examine, ready, report
from ecm_checker.outcome import Report
from ecm_checker.profiles import NO_PROFILES, Profiles


def install(module: Subject, profiles: Profiles = NO_PROFILES, dimensions: Sequence[Dimension] = ALL) -> Report:
    """May a module be admitted to a robot?

    Args:
        module: contract, or a view made of it.
        profiles: of robot, governance and installation.
        dimensions: those to consult, of the ones that the operation consults.
    """
    found = examine("install", Case((ready(module),), profiles), dimensions)
    return report("install", found, profiles, dimensions)
