"""ROS-native composition of a set of modules, matched by topic, service, action, frame and claim."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ecm_checker.case import Case
from ecm_checker.finding import Dimension
from ecm_checker.match.packages import Packages
from ecm_checker.operations.engine import ALL, Subject, examine, ready, report
from ecm_checker.outcome import Report
from ecm_checker.profiles import NO_PROFILES, Profiles


def system(
    modules: Iterable[Subject],
    profiles: Profiles = NO_PROFILES,
    dimensions: Sequence[Dimension] = ALL,
    *,
    together: bool = False,
    packages: Packages | None = None,
    started: Packages | None = None,
) -> Report:
    """May these modules run as one system?

    Args:
        modules: contracts or views, in any order.
        profiles: of robot, governance and installation.
        dimensions: those to consult, of the ones that the operation consults.
        together: whether they are known to run together, as by a launch file. Modules of a repository could, and
            then a conflict between two of them is only likely.
        packages: documents of their packages; None where there are none.
        started: nodes that launch files start, see `Case`; None where nothing is started.
    """
    views = sorted((ready(module) for module in modules), key=lambda each: each.id)
    libraries = [each for each in views if not each.runs]
    runs = [each for each in views if each.runs]
    case = Case(runs, profiles, together=together, packages=packages, started=started, libraries=libraries)
    return report("system", examine("system", case, dimensions), profiles, dimensions)
