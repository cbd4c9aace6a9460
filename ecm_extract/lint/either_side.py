"""Whether two statements of a body stand on different sides of one choice: no run has both."""

from __future__ import annotations

from ecm_parsers.source.flow import Block, Branch, Step, Switch, blocks, statements


def on_either_side(flow: Block, one: int, other: int) -> bool:
    """Tell whether an `if` or `#if`, a chain of them or a switch whose cases end leads to one of two, never to both."""
    for step in flow:
        if isinstance(step, int):
            continue
        sides = [set(statements(side)) for side in _sides(step)]
        places = [{at for at, side in enumerate(sides) if each in side} for each in (one, other)]
        if places[0] and places[1] and places[0].isdisjoint(places[1]):
            return True
        if any(on_either_side(inner, one, other) for inner in blocks(step)):
            return True
    return False


def _sides(step: Step) -> tuple[Block, ...]:
    if isinstance(step, Branch):
        return step.then, step.other
    if isinstance(step, Switch) and not step.falls:
        return tuple(case.body for case in step.cases)
    return ()
