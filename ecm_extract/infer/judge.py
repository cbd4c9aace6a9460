"""What a run asks of who evaluates expressions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from typing import TYPE_CHECKING, NamedTuple, Protocol

from ecm_parsers.source.expr import Call, Expr

from ecm_extract.infer.held import Held, State
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.rounds import Round
from ecm_extract.infer.routes import Fork, Verdict
from ecm_extract.infer.targets import Lending, Targets

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func
    from ecm_extract.link.running.env import Env


class Kept(NamedTuple):
    """An argument to which some object keeps a way: its place, and whether that object may change it."""

    at: int
    changes: bool


class Lasting(Protocol):
    """Who follows variables that outlive a call."""

    def keys(self, func: Func, at: int) -> Set[str]:
        """Return those, by key, that the calls of a statement may change."""

    def changed(self, env: Env, state: State) -> Mapping[str, tuple[Held, ...]]:
        """Return what the calls of a statement leave them with, by key."""

    def entered(self, key: str, env: Env) -> tuple[Held, ...] | None:
        """Return what one holds when a function begins; None of other variables, and where that is not known."""


class Lent(Lending, Protocol):
    """Who follows what functions change which are handed to the one at hand."""

    def keys(self, env: Env, at: int) -> Set[str]:
        """Return the variables, by key, that a statement changes by calling what its function was handed."""

    def changed(self, env: Env, state: State) -> Mapping[str, tuple[Held, ...]]:
        """Return what such calls of a statement leave these variables with, by key."""


class Methods(Protocol):
    """Who knows what methods change of the objects that they are called on."""

    def called_on(self, call: Call, env: Env) -> str | None:
        """Return the variable of the object that a method is called on: empty for that at hand, None for others."""

    def changed(self, call: Call, env: Env) -> Mapping[str, str] | None:
        """Return the members that a call of a method may change, each with its key there; None if that is unknown."""

    def changed_by(self, func: Func, env: Env) -> Set[str] | None:
        """Return the members that a function declared in another one changes, or methods that it calls; None: any."""

    def all_leave(self, name: str, func: Func) -> bool:
        """Tell whether no method of a name that a function sees changes its object."""


class Own(Protocol):
    """Who knows the calls that run functions of the tree."""

    def of(self, env: Env) -> Sequence[Call]:
        """Return the calls of a statement that may run functions of the tree."""

    def is_own(self, call: Call, func: Func, at: int) -> bool:
        """Tell whether a call in a statement of a function may run a function of the tree."""

    def reaches_object(self, call: Call, env: Env) -> bool:
        """Tell whether a call of a function of the tree may run a method of the object at hand."""


class Judge(Targets, Protocol):
    """Who evaluates expressions for a run."""

    @property
    def lasting(self) -> Lasting:
        """Who follows variables that outlive a call."""

    @property
    def lent(self) -> Lent:
        """Who follows what functions change which are handed to the one at hand."""

    @property
    def methods(self) -> Methods:
        """Who knows what methods change."""

    @property
    def own(self) -> Own:
        """Who knows the calls that run functions of the tree."""

    def truth(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds; None when that is not decided."""

    def text(self, expr: Expr, env: Env) -> str | None:
        """Return the text that an expression surely is; None where that is not known."""

    def likely(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds as long as nobody sets a parameter; None when that is not decided."""

    def decided(self, fork: Fork) -> Verdict:
        """Tell whether what a branch asks holds, or something raises, and whether it likely does."""

    def alike(self, one: Expr, other: Expr, env: Env) -> bool | None:
        """Tell whether two expressions have the same value; None when that is not decided."""

    def rounds(self, over: Expr, env: Env) -> list[Round] | None:
        """Return the rounds that a loop may have, in order; None where it may have others."""

    def assigns_own_way(self, target: Expr | None, env: Env) -> bool:
        """Tell whether the class of an object of C++ says what an assignment to it does."""

    def may_point(self, expr: Expr, env: Env) -> bool:
        """Tell whether what an expression of C++ is may be a pointer: its type says so, or is not known."""

    def kept_arguments(self, call: Call, env: Env) -> Sequence[Kept]:
        """Return the arguments of a call of C++ to which some object keeps a reference or pointer."""

    def is_fixed(self, key: str, env: Env) -> bool:
        """Tell whether nobody gives a member anything else once the constructor gave it what it holds."""

    def is_followed(self, key: str, env: Env) -> bool:
        """Tell whether it is known who changes a member, or a variable outside of functions, or a part, and when."""

    def runs_once(self, func: Func) -> bool:
        """Tell whether no program runs a function more than once."""

    def outline(self, func: Func) -> Outline:
        """Return what is known of a function before it runs."""

    def settle(self, held: Held) -> None:
        """Evaluate now, so that a long chain of changes needs no deep recursion later."""
