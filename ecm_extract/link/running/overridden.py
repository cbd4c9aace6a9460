"""Parameters whose defaults hold nothing at a place, since a run comes there only when somebody sets them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.infer.held import State
from ecm_extract.infer.routes import Gate
from ecm_extract.link.code.walk import children
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import OfParameter, Value, opened

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Overridden:
    """Takes defaults back: behind `if (n != 0)` a parameter that is 0 by default is anything else."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def without(self, values: tuple[Value, ...], env: Env) -> tuple[Value, ...]:
        """Return values at a place, open where they are the default of a parameter that somebody must have set."""
        asked = {parameter for value in values for parameter in _parameters(value)}
        names = self._at(env, asked) if asked else frozenset()
        return tuple([opened(value, names) for value in values]) if names else values

    def _at(self, env: Env, asked: Set[str]) -> Set[str]:
        """Those of some parameters that are set on every way to a place."""
        found = [self._on(state, asked) for state in self.folder.flow.states(env)]
        return frozenset.intersection(*found) if found else frozenset()

    def _on(self, state: State, asked: Set[str]) -> frozenset[str]:
        gates = [(turn.gate, turn.holds) for turn in state.path if turn.gate is not None]
        return frozenset(name for gate, holds in gates for name in self._set_by(gate, holds, asked))

    def _set_by(self, gate: Gate, holds: bool, asked: Set[str]) -> Set[str]:
        """The one parameter that a branch asks about, where its default leads to the other side."""
        names = {
            name
            for part in _variables(gate.test)
            for value in self.folder.fold(part, gate.env)
            for name in _parameters(value)
        }
        if len(names) != 1 or not names <= asked:
            return frozenset()
        verdict = self.folder.flow.decisions.of(gate)
        return names if verdict.holds is None and verdict.likely is (not holds) else frozenset()


def _parameters(value: Value) -> Iterator[str]:
    return (part.parameter for part in value.template if isinstance(part, OfParameter))


def _variables(expr: Expr) -> Sequence[Expr]:
    """The variables in a condition, and the calls that are none on a variable."""
    found, pending = list[Expr](), [expr]
    while pending:
        part = pending.pop()
        if isinstance(part, Name | Member):
            found.append(part)
        elif isinstance(part, Call):
            found.append(part)
            pending += [part.callee.base, *part.args] if isinstance(part.callee, Member) else part.args
        else:
            pending += children(part)
    return found
