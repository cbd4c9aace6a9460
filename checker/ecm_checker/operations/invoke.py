"""InvokeCompat(s, e, R, P): inputs, preconditions in state s, resources now, permissions, completion, failures."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_checker.case import Case
from ecm_checker.finding import Dimension
from ecm_checker.operations.engine import ALL, Subject, examine, ready, report
from ecm_checker.outcome import Report
from ecm_checker.profiles import NO_PROFILES, Call, Profiles


def invoke(
    module: Subject,
    call: Call,
    profiles: Profiles = NO_PROFILES,
    dimensions: Sequence[Dimension] = ALL,
) -> Report:
    """May an installed module be called now?

    Args:
        module: contract, or a view made of it.
        call: what the caller brings: inputs, state, what it can handle.
        profiles: of robot, governance and installation.
        dimensions: those to consult, of the ones that the operation consults.
    """
    found = examine("invoke", Case((ready(module),), profiles, call=call), dimensions)
    return report("invoke", found, profiles, dimensions)
