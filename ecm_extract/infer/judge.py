"""What a run asks of who evaluates expressions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from ecm_parsers.source.expr import Call, Expr

from ecm_extract.infer.effects import Targets
from ecm_extract.infer.held import Held
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.routes import Gate, Verdict

if TYPE_CHECKING:
    from ecm_extract.link.env import Bound, Env
    from ecm_extract.link.units import Func


class Judge(Targets, Protocol):
    """Who evaluates expressions for a run."""

    def truth(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds; None when that is not decided."""

    def decided(self, gate: Gate) -> Verdict:
        """Tell whether what a branch asks holds, and whether it likely does."""

    def alike(self, one: Expr, other: Expr, env: Env) -> bool | None:
        """Tell whether two expressions have the same value; None when that is not decided."""

    def rounds(self, over: Expr, env: Env) -> list[Bound] | None:
        """Return what a loop is over, each element once; None when not all of it is known."""

    def own_calls(self, env: Env) -> Sequence[Call]:
        """Return the calls of a statement that may run functions of the tree."""

    def reaches_object(self, call: Call, env: Env) -> bool:
        """Tell whether a call of a function of the tree may run a method of the object at hand."""

    def called_on(self, call: Call, env: Env) -> str | None:
        """Return the variable of the object that a method is called on: empty for that at hand, None for others."""

    def members_changed(self, call: Call, env: Env) -> Mapping[str, str] | None:
        """Return the members that a call of a method may change, each with its key there; None if that is unknown."""

    def is_followed(self, name: str, func: Func) -> bool:
        """Tell whether a function is the only one that changes a variable outside of functions, and runs once."""

    def runs_once(self, func: Func) -> bool:
        """Tell whether no program runs a function more than once."""

    def outline(self, func: Func) -> Outline:
        """Return what is known of a function before it runs."""

    def settle(self, held: Held) -> None:
        """Evaluate now, so that a long chain of changes needs no deep recursion later."""
