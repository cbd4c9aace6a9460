"""ChainCompat = all adjacent pairs and GlobalSafe: latency budget, audit, repeated locks, joint resources."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ecm_checker.case import Case
from ecm_checker.finding import Dimension
from ecm_checker.operations.engine import ALL, Subject, consulted, examine, findings, ready, report
from ecm_checker.operations.table import OPERATIONS
from ecm_checker.outcome import Report
from ecm_checker.profiles import NO_PROFILES, Profiles


def chain(
    modules: Sequence[Subject],
    profiles: Profiles = NO_PROFILES,
    dimensions: Sequence[Dimension] = ALL,
) -> Report:
    """May modules run one after the other, each handing over to the next?

    Args:
        modules: contracts or views, in the order of the chain.
        profiles: of robot, governance and installation.
        dimensions: those to consult, of the ones that the operation consults.
    """
    views = [ready(module) for module in modules]
    found = []
    for pair in pairwise(views):
        found += examine("compose", Case(pair, profiles, ordered=True), dimensions)
    wanted = tuple(each for each in OPERATIONS["chain"].dimensions if each in dimensions)
    found += findings(Case(views, profiles, ordered=True), consulted(("GlobalSafe",), wanted))
    return report("chain", found, profiles, dimensions)
