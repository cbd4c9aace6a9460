"""What the functions of one module hand to others by a parameter: `Monitor monitor(node)` in `main`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.naming.handle import OWN, Handle, under
from ecm_extract.link.owning.modules import Module, Modules
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.values import literal, unknown

OPEN_NODE: Final = Handle(literal(""), under(unknown("namespace"), unknown("name")))
MAX_HANDING: Final = 200
"""Parameters through which a node is followed from one function to the next."""


class _Parameter(NamedTuple):
    """A parameter of a function, and the class of the object that it runs on."""

    func: Func
    name: str
    this: Cls | None


class NodesHanded:
    """Finds what the calls of a module give to functions; each parameter is asked about once.

    Args:
        sites: knows the calls.
        modules: tells whose a function is.
        module: whose calls count.
    """

    def __init__(self, sites: Sites, modules: Modules, module: Module) -> None:
        self.sites = sites
        self._modules = modules
        self._module = module
        self._known: dict[_Parameter, Handle | None] = {}

    def of(self, func: Func, name: str, this: Cls | None, known: Callable[[Bound], Handle | None]) -> Handle | None:
        """Return any of the nodes that a parameter is, by what `known` tells of what calls give; None of none."""
        asked = _Parameter(func, name, this)
        if asked not in self._known:
            self._known[asked] = None  # who asks in a circle
            self._known[asked] = several([known(each) for each in self._origins(asked)])
        return self._known[asked]

    def _origins(self, asked: _Parameter) -> list[Bound]:
        """What is given in the end, through functions that hand on what they are given."""
        found: list[Bound] = []
        pending = {asked: self._given(asked)}
        seen: set[_Parameter] = set()
        while pending and len(seen) < MAX_HANDING:
            seen.add(current := next(iter(pending)))
            for bound in pending.pop(current):
                further = self._handed_on(bound)
                given = self._given(further) if further is not None and further not in seen else ()
                if further is not None and given:
                    pending[further] = given
                elif further not in seen:
                    found.append(bound)
        return found

    def _handed_on(self, bound: Bound) -> _Parameter | None:
        """The parameter of its function that a call hands on as it is; None of anything else."""
        expr, env = bound.expr, bound.env
        given = isinstance(expr, Name) and any(entry.name == expr.id for entry in env.func.fact.params)
        if not given or not isinstance(expr, Name) or self.sites.folder.origins.makers(expr, env):
            return None
        return _Parameter(env.func, expr.id, env.this)

    def _given(self, asked: _Parameter) -> Sequence[Bound]:
        given = (
            bind(asked.func, call, self.sites.root_env(call.func, call.at)).get(asked.name)
            for call in dict.fromkeys(self._calls(asked.func, asked.this))
            if self._module in self._modules.owners(call.func.holder or call.func)
        )
        return [bound for bound in given if bound is not None]

    def _calls(self, func: Func, this: Cls | None) -> Iterator[Invocation]:
        """The calls of a function, or those that make the object whose constructor it is."""
        if not func.is_constructor:
            yield from self.sites.callers(func)
        elif func.cls is not None:
            made = (call for call in self.sites.makers(func.cls) if self._chooses(call, func, func.cls))
            yield from (
                call for call in made if this in (None, func.cls) or self.sites.making.is_base_of(call, func.cls)
            )

    def _chooses(self, call: Invocation, func: Func, cls: Cls) -> bool:
        return self.sites.folder.objects.constructor(cls, call) is func


def several(found: Iterable[Handle | None]) -> Handle | None:
    """Return the node that may be any of several; None where none is known, or the one at hand beside unknown ones."""
    known = dict.fromkeys(found)
    nodes = [each for each in known if each is not None]
    if nodes in ([], [OWN]):
        return next(iter(nodes), None)
    nodes += [OPEN_NODE] * (None in known)
    first, *others = [each.as_choice() for each in nodes] if len(nodes) > 1 else nodes
    return first._replace(others=tuple(others))
