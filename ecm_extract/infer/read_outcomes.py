"""What a variable holds behind `if (nh.getParam("rate", rate))`: what was read where there was one, or what it was.

A call that reads a parameter into a variable tells whether it did, and leaves the variable as it is where it did not
(ros/node_handle.h, ros/param.h, rclcpp/node.hpp). Where both sides meet again the variable is what it was before.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_parsers.source.expr import Call, Expr, Op

from ecm_extract.infer.held import Held, Part, State
from ecm_extract.infer.run import Frame


def read_outcomes(frame: Frame, test: Expr, state: State, holds: bool) -> Mapping[str, tuple[Held, ...]]:
    """Return what variables hold on one side of a test that asks whether parameters were read into them."""
    if not frame.outline.reads:
        return {}
    found: dict[str, tuple[Held, ...]] = {}
    for call, done in _known(test, holds):
        for arg in call.args:
            key = frame.effects.key(arg)
            ways: tuple[Held, ...] = state.holds.get(key, ()) if key else ()
            if len(ways) == 1 and _is_read_by(ways[0], call):
                found[key] = _outcome(ways[0], state, done)
    return found


def _known(test: Expr, holds: bool) -> Iterator[tuple[Call, bool]]:
    """The calls of which a side of a test tells what they gave back."""
    if isinstance(test, Call):
        yield test, holds
    elif isinstance(test, Op) and test.op == "!":
        yield from _known(test.operands[0], not holds)
    elif isinstance(test, Op) and test.op == ("&&" if holds else "||"):
        for operand in test.operands:
            yield from _known(operand, holds)


def _is_read_by(held: Held, call: Call) -> bool:
    return held.how == "read" and held.more is None and held.whole is None and held.expr in call.args


def _outcome(held: Held, state: State, done: bool) -> tuple[Held, ...]:
    if done:
        return (Held("read", held.name, held.expr, held.env, held.at, whole=held),)
    if not held.before:
        return (held,)
    return (Held("met", held.name, parts=(Part(state.route, held.before),), since=state.route, whole=held),)
