"""Parameters whose defaults hold nothing at a place, since a run comes there only when somebody sets them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.infer.held import State
from ecm_extract.infer.routes import Gate
from ecm_extract.link.code.walk import children
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, opened, parameters_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Overridden:
    """Takes defaults back: behind `if (n != 0)` a variable that a parameter makes 0 by default is anything else."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def without(self, values: tuple[Value, ...], expr: Name | Member, env: Env) -> tuple[Value, ...]:
        """Return the values of a variable at a place, open where they are defaults that branches on it rule out."""
        asked = frozenset(parameter for value in values for parameter in parameters_of(value))
        key = self.folder.flow.effects(env.func).key(expr) if asked else ""
        names = self._at(key, env) & asked if key else frozenset[str]()
        return tuple([opened(value, names) for value in values]) if names else values

    def _at(self, key: str, env: Env) -> frozenset[str]:
        """The parameters of a variable that are set on every way to a place."""
        found = [self._on(state, key) for state in self.folder.flow.states(env)]
        return frozenset.intersection(*found) if found else frozenset()

    def _on(self, state: State, key: str) -> frozenset[str]:
        gates = [(turn.gate, turn.holds) for turn in state.path if turn.gate is not None]
        return frozenset(name for gate, holds in gates for name in self._set_by(gate, holds, key))

    def _set_by(self, gate: Gate, holds: bool, key: str) -> Iterator[str]:
        """The parameter behind a variable, where what a branch asks of that alone has its default on the other side."""
        for test, side in _parts(gate.test, holds):
            variables = list(_variables(test))
            effects = self.folder.flow.effects(gate.env.func)
            if variables and all(effects.key(each) == key for each in variables):
                values = self.folder.fold(variables[0], gate.env)
                names = {name for value in values for name in parameters_of(value)}
                proved, likely = self.folder.flow.verdict(test, gate.env)
                yield from names if len(names) == 1 and proved is None and likely is (not side) else ()


def _parts(test: Expr, holds: bool) -> Iterator[tuple[Expr, bool]]:
    """Yield what has to hold, or not to hold, for one side of a branch: all of `a && b`, none of `a || b`."""
    if isinstance(test, Op) and test.op == "!":
        yield from _parts(test.operands[0], not holds)
    elif isinstance(test, Op) and test.op == ("&&" if holds else "||"):
        for part in test.operands:
            yield from _parts(part, holds)
    else:
        yield test, holds


def _variables(expr: Expr) -> Iterator[Expr]:
    """Yield the variables of a condition; of a call the object, or else the function, and the arguments."""
    if isinstance(expr, Name | Member):
        yield expr
    elif isinstance(expr, Call):
        inner = [expr.callee.base if isinstance(expr.callee, Member) else expr.callee, *expr.args]
        for part in inner:
            yield from _variables(part)
    else:
        for part in children(expr):
            yield from _variables(part)
