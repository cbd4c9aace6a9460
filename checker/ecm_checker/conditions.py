"""What is known to hold when a module starts."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.frames import known
from ecm_checker.predicates import Predicate, fact
from ecm_checker.view import View


def known_in_state(case: Case) -> tuple[Predicate, ...]:
    """Facts of the runtime profile and of the caller's state; the state is newer and wins."""
    runtime, call = case.profiles.runtime, case.call
    facts = {**(runtime.facts if runtime is not None else {}), **(call.state if call is not None else {})}
    return tuple(fact(name, value) for name, value in facts.items())


def established(case: Case, module: View) -> tuple[Predicate, ...]:
    """What holds after a module: its postconditions, the frames of its output, facts that these do not touch."""
    after = (*(module.postconditions or ()), *_output_frames(module))
    touched = {each.subject for each in after}
    return (*after, *(each for each in known_in_state(case) if each.subject not in touched))


def _output_frames(module: View) -> Iterator[Predicate]:
    for field in module.outputs or ():
        frame = known(field.frame)
        if frame is not None:
            yield fact(f"{field.name}.frame", frame)
