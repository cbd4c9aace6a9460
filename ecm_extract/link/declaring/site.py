"""One call of a form, with the calls through which its name comes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from ecm_parsers.source.expr import Expr

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import names_in
from ecm_extract.link.declaring.forms import Form
from ecm_extract.link.folding.spreading import Spread
from ecm_extract.link.running.env import Env


@dataclass(slots=True, eq=False, repr=False)
class Site:
    """A call that is a form, seen from the outermost call that fixes its name.

    Attributes:
        form: the row.
        call: the innermost call, the form itself.
        env: where its arguments are evaluated.
        chain: the calls it came through, outermost first; empty for a direct call.
        owner: class whose objects have the endpoint; None for a free function's.
        root: outermost function.
        places: where each call of the chain is evaluated.
        certain: whether a run that gets to the call makes the endpoint; False for one of several that it may make.
        sole: whether no object that its calls may mean runs another method instead.
        written: of a call that spreads its arguments how it is written, and its place; None of others.
        exact: the class of the objects that it is told of, where those of derived classes have sites of their own.
    """

    form: Form
    call: Invocation
    env: Env
    chain: tuple[Invocation, ...]
    owner: Cls | None
    root: Func
    places: tuple[Env, ...] = ()
    certain: bool = True
    exact: Cls | None = None
    sole: bool = True
    written: Spread | None = None

    def as_written(self) -> Site:
        """Return the same with the call as its source writes it."""
        if self.written is None:
            return self
        return replace(self, call=self.written.call, env=self.written.env, written=None)

    @property
    def is_absolute(self) -> bool:
        """Whether its row implies the whole name, which no handle and no node changes."""
        return self.form.fixed.startswith("/")

    @property
    def first(self) -> Invocation:
        """The outermost call."""
        return self.chain[0] if self.chain else self.call

    def takes(self, expr: Expr) -> bool:
        """Whether an argument is made of what the outermost function is given, and nobody says what that is."""
        open_ = self.root.given - self.env.args.keys() if self.env.func is self.root else frozenset[str]()
        return not open_.isdisjoint(names_in(expr))

    def steps(self) -> Iterator[tuple[Invocation, Env]]:
        """Yield each call with where it is evaluated, outermost call first."""
        yield from zip((*self.chain, self.call), (*self.places, self.env), strict=True)

    def lines(self) -> Iterator[tuple[str, int]]:
        """Yield (path, line), outermost call first, and where the site itself stands last."""
        found = [(call.func.file.path, call.line) for call in (*self.chain, self.call)]
        yield from reversed(dict.fromkeys(reversed(found)))


def overrides(func: Func) -> bool:
    """Tell whether whoever calls a function may know its base class only, as the host of a plugin does."""
    return "override" in func.fact.traits
