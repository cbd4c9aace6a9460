"""What the functions of one module hand to others by a parameter: `Monitor monitor(node)` in `main`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.naming.handle import OWN, Handle
from ecm_extract.link.owning.modules import Module, Modules
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.values import unknown

OPEN_NODE = Handle(unknown(""), unknown("name"))


class NodesHanded:
    """Finds the calls of a module that enter a function.

    Args:
        sites: knows the calls.
        modules: tells whose a function is.
        module: whose calls count.
    """

    def __init__(self, sites: Sites, modules: Modules, module: Module) -> None:
        self.sites = sites
        self._modules = modules
        self._module = module

    def of(self, func: Func, parameter: str, this: Cls | None) -> Sequence[Bound]:
        """Return what each call gives a function by a parameter, with the place of the call."""
        given = (
            bind(func, call, self.sites.root_env(call.func, call.at)).get(parameter)
            for call in dict.fromkeys(self._calls(func, this))
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
    """Return the node that may be any of several; None where none of them is known."""
    known = dict.fromkeys(found)
    nodes = [each for each in known if each is not None]
    if len(nodes) <= 1:
        return OPEN_NODE if None in known and nodes not in ([], [OWN]) else next(iter(nodes), None)
    first, *others = [each.as_choice() for each in (*nodes, *[OPEN_NODE] * (None in known))]
    return first._replace(others=tuple(others))
